#include "sim/apps/report/page.hpp"

#include <cmath>
#include <cstdio>
#include <string_view>

namespace earshot::report {
namespace {

constexpr std::string_view kHead = R"(<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"><meta name="viewport" content="width=device-width, initial-scale=1">
<title>Earshot: one search</title><style>
:root { color-scheme: light dark; --ink: #1d2733; --soft: #5c6b7a; --line: #d9e0e7; --paper: #ffffff; --card: #f4f7fa; --bar: #3f8fc5; --good: #1f8a5f; --bad: #b5371c; }
@media (prefers-color-scheme: dark) { :root { --ink: #e4eaf0; --soft: #9aa8b5; --line: #2d3843; --paper: #12181f; --card: #1a222b; --bar: #5aa9dc; --good: #46c493; --bad: #e8734f; } }
body { margin: 0 auto; max-width: 62rem; padding: 2rem 1.25rem 4rem; background: var(--paper); color: var(--ink); font: 16px/1.5 system-ui, sans-serif; }
h1 { font-size: 1.7rem; margin: 0 0 .25rem; } h2 { font-size: 1.15rem; margin: 2.25rem 0 .75rem; } p { color: var(--soft); margin: .25rem 0; }
.found { color: var(--good); } .missed { color: var(--bad); }
dl { display: grid; grid-template-columns: repeat(auto-fit, minmax(9.5rem, 1fr)); gap: .75rem; margin: 1.25rem 0 0; }
dl div { background: var(--card); border-radius: .5rem; padding: .6rem .8rem; } dt { color: var(--soft); font-size: .82rem; } dd { margin: 0; font-size: 1.2rem; font-variant-numeric: tabular-nums; }
svg { width: 100%; height: auto; } .table { overflow-x: auto; }
table { border-collapse: collapse; width: 100%; font-size: .85rem; font-variant-numeric: tabular-nums; } th { text-align: right; color: var(--soft); font-weight: 600; }
th, td { padding: .2rem .5rem; border-bottom: 1px solid var(--line); text-align: right; white-space: nowrap; } .heard { color: var(--good); }
td.p { position: relative; min-width: 2.6rem; } td.p i { position: absolute; inset: .2rem auto .2rem .2rem; background: var(--bar); opacity: .35; border-radius: 2px; } td.p.taken { font-weight: 700; }
</style></head><body>
)";

std::string number(double x, int digits) {
  char text[64];
  (void)std::snprintf(text, sizeof text, "%.*f", digits, x);
  return text;
}

std::string escaped(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if (c == '<')
      out += "&lt;";
    else if (c == '>')
      out += "&gt;";
    else if (c == '&')
      out += "&amp;";
    else
      out += c;
  }
  return out;
}

std::string duration(double s) {
  const int minutes = static_cast<int>(std::lround(s / 60.0));
  return minutes < 60 ? std::to_string(minutes) + " min" : std::to_string(minutes / 60) + " h " + std::to_string(minutes % 60) + " min";
}

std::string fact(const char* name, const std::string& value) {
  return "<div><dt>" + std::string(name) + "</dt><dd>" + value + "</dd></div>\n";
}

std::string headline(const nlohmann::json& s) {
  const bool found = s.at("found");
  const std::string steps = std::to_string(s.at("steps").get<int>()) + " steps";
  std::string text = found ? "<h1 class=\"found\">Source found after " + steps + "</h1>\n"
                           : "<h1 class=\"missed\">Source not found in " + steps + "</h1>\n";
  if (!found) text += "<p>The mission ended because: " + escaped(s.at("end_reason").get<std::string>()) + "</p>\n";
  return text + "<p>Seed " + std::to_string(s.at("seed").get<std::uint64_t>()) + " &middot; mission " +
         escaped(s.at("mission").get<std::string>()) + " &middot; ocean " + escaped(s.at("environment").get<std::string>()) + "</p>\n";
}

std::string facts(const nlohmann::json& s) {
  const double sim = s.at("sim_time_s");
  const double wall = s.at("wall_time_s");
  return "<dl>\n" + fact("reward", number(s.at("reward"), 1)) +
         fact("steps with a detection", std::to_string(s.at("detections").get<int>())) +
         fact("distance", number(s.at("distance_m").get<double>() / 1e3, 1) + " km") + fact("time at sea", duration(sim)) +
         fact("time to simulate", number(wall, 2) + " s") + fact("times real time", wall > 0 ? number(sim / wall, 0) : "-") + "</dl>\n";
}

/// "N", "NE", ... where the actions are eight compass directions; otherwise degrees.
std::string action_name(std::size_t action, std::size_t count) {
  constexpr std::string_view kEight[] = {"N", "NE", "E", "SE", "S", "SW", "W", "NW"};
  if (count == 8) return std::string(kEight[action]);
  if (count == 4) return std::string(kEight[2 * action]);
  return number(360.0 * static_cast<double>(action) / static_cast<double>(count), 0) + "&deg;";
}

std::string row(const DecisionRow& d) {
  std::string text = "<tr><td>" + std::to_string(d.step) + "</td><td>" + duration(d.time_s) + "</td><td>" + number(d.north_m / 1e3, 2) +
                     "</td><td>" + number(d.east_m / 1e3, 2) + "</td><td" + (d.detected ? " class=\"heard\"" : "") + ">" +
                     number(d.snr_db, 1) + (d.detected ? " &#9679;" : "") + "</td>";
  for (std::size_t a = 0; a < d.probabilities.size(); ++a) {
    const std::string percent = number(100.0 * d.probabilities[a], 0);
    text += std::string("<td class=\"p") + (static_cast<int>(a) == d.action ? " taken" : "") +
            "\"><i style=\"width:" + number(2.2 * d.probabilities[a], 2) + "rem\"></i>" + percent + "</td>";
  }
  return text + "<td>" + (d.overridden ? "way-point moved" : "") + "</td></tr>\n";
}

std::string decisions(const Flight& flight) {
  if (flight.decisions.empty()) return "<p>The policy took no decision.</p>\n";
  const std::size_t count = flight.decisions.front().probabilities.size();
  std::string text =
      "<p>Percent: how likely the policy made each direction; bold: the one taken; &#9679;: source heard.</p>\n<div "
      "class=\"table\"><table>\n<tr><th>step</th>"
      "<th>at</th><th>north (km)</th><th>east (km)</th><th>SNR (dB)</th>";
  for (std::size_t a = 0; a < count; ++a) text += "<th>" + action_name(a, count) + "</th>";
  text += "<th>safety</th></tr>\n";
  for (const DecisionRow& d : flight.decisions) text += row(d);
  return text + "</table></div>\n";
}

}  // namespace

std::string page(const Flight& flight, const std::string& map, const std::string& history) {
  std::string text{kHead};
  text += headline(flight.summary) + facts(flight.summary);
  if (!flight.journal_is_whole)
    text += "<p class=\"missed\">The journal does not end with a whole record: the runtime was stopped while it wrote.</p>\n";
  text += "<h2>Where it went</h2>\n<p>SNR at the vehicle's depth; warm colours: loud enough to be heard.</p>\n" + map;
  text += "<h2>What it heard</h2>\n" + history;
  text += "<h2>What it decided</h2>\n" + decisions(flight);
  return text + "</body></html>\n";
}

}  // namespace earshot::report
