#include "policy/report/html.hpp"

#include <cmath>

#include "policy/explain/wording.hpp"

namespace earshot::report {
namespace {

constexpr std::string_view kStyle = R"(
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
th.left, td.left { text-align: left; white-space: normal; } td.for i { background: var(--good); } td.against i { background: var(--bad); }
.two { display: grid; grid-template-columns: repeat(auto-fit, minmax(22rem, 1fr)); gap: 1.25rem; align-items: start; } .words { color: var(--ink); } .words li { margin: .2rem 0; }
.chart { max-width: 42rem; margin: 0 auto; } .chart image { image-rendering: pixelated; } summary { cursor: pointer; color: var(--soft); } tr.why > td { text-align: left; white-space: normal; border-bottom: 1px solid var(--line); padding-bottom: .6rem; } h3 { font-size: 1rem; margin: 1rem 0 .4rem; }
)";

}  // namespace

std::string html_head(const std::string& title) {
  return R"(<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"><meta name="viewport" content="width=device-width, initial-scale=1">
<title>)" +
         escaped(title) + "</title><style>" + std::string(kStyle) + "</style></head><body>\n";
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

std::string fact(std::string_view name, const std::string& value) {
  return "<div><dt>" + std::string(name) + "</dt><dd>" + value + "</dd></div>\n";
}

std::string percent_cell(double share, double full_rem, bool is_taken) {
  return std::string("<td class=\"p") + (is_taken ? " taken" : "") + "\" style=\"min-width:" + explain::fixed(full_rem + 0.4, 1) +
         "rem\"><i style=\"width:" + explain::fixed(full_rem * share, 2) + "rem\"></i>" + explain::fixed(100.0 * share, 0) + "</td>";
}

std::string duration(double s) {
  const int minutes = static_cast<int>(std::lround(s / 60.0));
  return minutes < 60 ? std::to_string(minutes) + " min" : std::to_string(minutes / 60) + " h " + std::to_string(minutes % 60) + " min";
}

}  // namespace earshot::report
