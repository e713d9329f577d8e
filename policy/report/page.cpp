#include "policy/report/page.hpp"

#include <algorithm>
#include <span>

#include "firmware/host/file/printable.hpp"
#include "firmware/host/journal/words/wording.hpp"
#include "firmware/host/text/duration.hpp"
#include "firmware/host/text/numbers.hpp"
#include "firmware/host/toml/table_reader.hpp"
#include "firmware/messages/dictionary/mission_words.hpp"
#include "firmware/policy/action_draw.hpp"
#include "policy/explain/wording.hpp"
#include "policy/report/belief_pictures.hpp"
#include "policy/report/conditions.hpp"
#include "policy/report/explanation.hpp"
#include "policy/report/html.hpp"
#include "policy/report/plots.hpp"
#include "policy/report/recorded_flight.hpp"
#include "policy/report/sea/sea_plots.hpp"
#include "policy/report/sea_page.hpp"
#include "policy/report/sound/sound_plots.hpp"
#include "sim/search/account/numbers.hpp"
#include "sim/search/account/search_account.hpp"
#include "sim/search/actions/compass_directions.hpp"
#include "sim/search/settings.hpp"

namespace earshot::report {
namespace {

using explain::fixed;

constexpr std::size_t kRowsOfAttribution = 5;

std::string account_paragraph(const search::SearchAccount& account) {
  const std::string text = search::to_string(account);
  return text.empty() ? "" : "<p>" + escaped(text) + "</p>\n";
}

/// A rule or an order may end the mission within a step: its decision was taken, the step was not.
std::string unfinished_step(const Flight& flight, std::size_t steps) {
  const std::size_t decisions = flight.journal.decisions.size();
  if (decisions != steps + 1) return "";
  return "<p>The mission ended within the step of the last of " + std::to_string(decisions) + " decisions, which does not count.</p>\n";
}

constexpr const char* kMeasuredAlone =
    " It measured the SNR at its own place, and nothing more: it never saw where the source is, nor the coloured field of the map.";
constexpr const char* kMeasuredInVain =
    " Its policy goes by the vehicle's place and steps alone, and uses no measurement. It never saw where the source is, nor the coloured "
    "field of the map.";

constexpr const char* kOrdersOfASimulation =
    "The simulator gave the orders: START, COMPLETE once the vehicle was within a step length of the source, ABORT where the flight was "
    "stopped.";

/// The account of a summary; an earlier version's does not have the rule that ended the flight, but its journal does.
search::SearchAccount account_of(const Flight& flight) {
  search::SearchAccount account = search::account_in(flight.summary);
  if (account.ending_rule.empty() && flight.ending_rule) account.ending_rule = *flight.ending_rule;
  return account;
}

/// The flight's summary counts a step that the source cut short as the others: one count, with a word about the last.
std::string headline(const Flight& flight, bool uses_measurements) {
  const nlohmann::json& s = flight.summary;
  if (flight.sea) return sea_headline(*flight.sea, flight.journal) + account_paragraph(flight.sea->account);
  if (s.is_null()) return "<h1 class=\"missed\">A flight without its end</h1>\n";
  const int steps = s.at("steps");
  const search::SearchAccount account = account_of(flight);
  const search::Verdict verdict = search::verdict_on(account);
  std::string text = std::string("<h1 class=\"") + (verdict.is_found ? "found" : "missed") + "\">" + escaped(verdict.text) + "</h1>\n";
  if (const std::string end = search::end_to_string(account); !account.is_found && verdict.text.find(end) == std::string::npos)
    text += "<p>The mission ended after " + host::counted(static_cast<std::uint64_t>(steps), "step") + ": " + escaped(end) + ".</p>\n";
  text += "<p class=\"note\">" + std::string(kSimulationNote) + (uses_measurements ? kMeasuredAlone : kMeasuredInVain) + "</p>\n" +
          unfinished_step(flight, static_cast<std::size_t>(steps));
  if (s.value("whole_steps", steps) < steps) text += "<p>The last step was cut short by the source.</p>\n";
  return text + account_paragraph(account) + "<p>Seed " + std::to_string(s.at("seed").get<std::uint64_t>()) + " &middot; mission " +
         escaped(s.at("mission").get<std::string>()) + " &middot; ocean " + escaped(s.at("environment").get<std::string>()) + "</p>\n";
}

/// What the page lacks, and how much of the journal was read.
std::string shortcomings(const Flight& flight) {
  std::string text;
  for (const std::string& name : flight.missing) text += (text.empty() ? "Not there: " : ", ") + name;
  if (!text.empty())
    text = "<p class=\"missed\">" + text + ". A simulator that is stopped at sea does not write them; this page is of the rest.</p>\n";
  if (!flight.journal.is_whole()) text += "<p class=\"missed\">" + lack_of(flight.journal) + "</p>\n";
  return text;
}

/// A policy without a belief has no rule that could declare anything.
std::string declared_fact(const search::SearchAccount& account) {
  if (!account.believes && !account.declared_step) return "";
  return fact("declared", account.declared_step ? "at step " + std::to_string(*account.declared_step) : "no", search::kDeclaredMeans);
}

std::string facts(const Flight& flight) {
  const nlohmann::json& s = flight.summary;
  if (flight.sea) return sea_facts(*flight.sea, flight.journal);
  if (s.is_null()) return "";
  const search::SearchAccount account = account_of(flight);
  const double sim = s.at("sim_time_s");
  const double wall = s.at("wall_time_s");
  return cards_of(conditions_in(s)) + "<dl>\n" + fact("reward", fixed(s.at("reward"), 1), search::kRewardMeans) +
         fact("detections", std::to_string(s.at("detections").get<int>()), search::detection_means(s.at("detection_threshold_db"))) +
         fact("found", search::verdict_on(account).is_found ? "yes" : "no", search::found_means(account.step_length_m)) +
         declared_fact(account) + fact("distance", fixed(s.at("distance_m").get<double>() / 1e3, 1) + " km") +
         (s.contains("battery_percent") ? fact("battery left", fixed(s.at("battery_percent"), 1) + " %") : "") +
         fact("time at sea", host::duration(sim),
              "in simulated time; computed in " + fixed(wall, 2) + " s, " + (wall > 0 ? fixed(sim / wall, 0) : "-") + " times real time") +
         "</dl>\n";
}

/// The actions of a policy that may be missing: the compass directions that every policy has.
search::ActionTable directions_of(std::size_t count) {
  return count == 0 ? search::ActionTable{} : search::compass_directions(count);
}

std::vector<double> probabilities_of(const explain::RecordedDecision& d) {
  std::vector<float> p(d.action_logits().size());
  if (!p.empty()) policy::softmax(d.action_logits(), p);
  return {p.begin(), p.end()};
}

std::string cell(std::string_view name, const std::string& value, const char* of_class = "") {
  return "<td data-name=\"" + std::string(name) + "\"" + (*of_class != 0 ? " class=\"" + std::string(of_class) + "\"" : "") + ">" + value +
         "</td>";
}

/// @param began_s  from when the page counts its times
std::string row(const explain::RecordedDecision& d, double began_s, const std::vector<std::string>& directions) {
  std::string text =
      "<tr class=\"step\">" + cell("step", std::to_string(d.step)) + cell("at", host::duration(d.time_s() - began_s)) +
      cell("north (km)", fixed(d.position.north.value / 1e3, 2)) + cell("east (km)", fixed(d.position.east.value / 1e3, 2)) +
      cell("SNR (dB)", (d.too_faint ? "&lt; " : "") + fixed(d.snr.value, 1) + (d.detected ? " &#9679;" : ""), d.detected ? "heard" : "");
  const std::vector<double> probabilities = probabilities_of(d);
  for (std::size_t a = 0; a < probabilities.size(); ++a) text += percent_cell(directions[a], probabilities[a], a == d.action);
  return text + "<td>" + (d.sweeping ? "sweep" : "") + (d.sweeping && d.overridden ? ", " : "") + (d.overridden ? "way-point moved" : "") +
         "</td></tr>\n";
}

std::string reasons(const explain::DecisionAccount& account, const std::string& chart, std::size_t columns) {
  std::string text = "<tr class=\"why\"><td colspan=\"" + std::to_string(columns) + "\"><details><summary>" +
                     (account.decision.sweeping ? "sweep, going " : "why ") + account.actions[account.decision.action].name +
                     "</summary>\n<ul class=\"words\">\n";
  for (const std::string& sentence : sentences(account)) text += "<li>" + escaped(sentence) + "</li>\n";
  text += "</ul>\n<div class=\"chart cells\">" + chart + "</div>\n";
  if (!account.decision.sweeping)  // the policy chose nothing there
    text += actions_table(account);
  if (!account.decision.sweeping && has_network(account))
    text += std::string("<h3>What moved the choice</h3>\n<p>") + kPartsMean + "</p>\n" + attribution_tables(account, kRowsOfAttribution);
  return text + "</details></td></tr>\n";
}

/// Only a policy that is there can be asked how it chooses.
std::string percents_mean(const FlightExplanation& explanation) {
  if (explanation.accounts.empty()) return "what the policy made of each direction";
  const explain::DecisionAccount& account = explanation.accounts.front();
  if (account.draw != policy::ActionDraw::kArgmax) return "how probable the policy made each direction";
  return std::string("the score of each direction") + (has_network(account) ? "" : ", made from its regret") +
         ", of which the policy takes the highest";
}

std::string decisions(const Flight& flight, const FlightExplanation& explanation) {
  const std::vector<explain::RecordedDecision>& taken = flight.journal.decisions;
  if (taken.empty()) return "<p>The policy took no decision.</p>\n";
  std::string text =
      "<p>A row is the decision that begins a step, the first that of step 0. Its SNR was measured before it. What was measured at the end "
      "of the last step has no row, but counts among the detections and in the reward. Percent: " +
      percents_mean(explanation) + "; bold: the one taken; &#9679;: a detection" +
      (std::ranges::any_of(taken, &explain::RecordedDecision::too_faint) ? "; &lt;: too faint to measure, the SNR lies below this" : "") +
      ". A step of a sweep is marked: its direction follows parallel tracks over the area, and not the policy.</p>\n";
  if (!explanation.why_not.empty()) text += "<p>Not explained: " + escaped(explanation.why_not) + "</p>\n";
  text +=
      "<div class=\"table\"><table class=\"decisions\">\n<thead><tr><th>step</th><th>at</th><th>north (km)</th><th>east (km)</th><th>SNR "
      "(dB)</th>";
  std::vector<std::string> directions;
  for (const UnitNorthEast& direction : directions_of(taken.front().action_logits().size()))
    text += "<th>" + directions.emplace_back(explain::direction_name(direction)) + "</th>";
  text += "<th>remark</th></tr></thead>\n<tbody>\n";
  for (std::size_t i = 0; i < taken.size(); ++i) {
    text += row(taken[i], flight.sea ? journal::seconds_of(flight.sea->began) : 0.0, directions);
    if (i < explanation.accounts.size()) text += reasons(explanation.accounts[i], explanation.charts[i], directions.size() + 6);
  }
  return text + "</tbody></table></div>\n";
}

std::string map_to_string(const Flight& flight) {
  if (flight.sea) return "By its own navigation, in kilometres of the mission's plane.";
  return "The coloured field is the truth, the SNR at the vehicle's depth as the simulation computes it. The vehicle never saw it. Warm "
         "colours: the source can be detected, with " +
         fixed(flight.summary.at("detection_threshold_db"), 0) + " dB or more. The source's mark, too, is known to the simulation alone.";
}

std::string history_to_string(const Flight& flight) {
  if (flight.sound.is_there())
    return "<p>The SNR that the simulation computes for the vehicle's place, which the vehicle never received.</p>\n";
  if (!flight.sea)
    return "<p>Above: the SNR at the vehicle's place, which it measures. Below: its range to the source, which the simulation alone "
           "knows.</p>\n";
  return "<p>Dots: every SNR that came in. Circles: the SNR of a decision, by the mission's way of listening; from the threshold on "
         "it is a detection.</p>\n";
}

std::string sound_to_string(const Flight& flight) {
  return "The vehicle measured the SNR in sound. Above: each SNR that it measured, beside the one that the simulation computes there; "
         "one that was too faint is only known to lie below its mark. Below: the spectrogram of the sound at its hydrophone, with a bar "
         "over it while measured SNRs were at the threshold or above. For the first " +
         fixed(flight.summary.at("hearing").at("search_began_s"), 0) + " s it lay at its start, to learn the noise of the sea.";
}

}  // namespace

Pictures pictures_of(const Flight& flight) {
  if (flight.sea)
    return {.map = sea_map_svg(*flight.sea, flight.journal.decisions), .history = sea_history_svg(*flight.sea, flight.journal.decisions)};
  if (!flight.is_complete() || flight.summary.is_null()) return {};  // a journal alone may not even begin with its mission
  Pictures pictures{.map = map_svg(flight), .history = history_svg(flight)};
  if (flight.sound.is_there()) {
    const Decibels threshold{flight.summary.at("detection_threshold_db").get<double>()};
    pictures.sound = sound_svg(flight.sound, threshold, flight.journal.decisions);
  }
  return pictures;
}

FlightExplanation explain_flight(const std::filesystem::path& folder_or_journal) try {
  const RecordedFlight flight = open_recording(folder_or_journal, {});
  FlightExplanation explanation{
      .uses_measurements = explain::uses_measurements(flight.policy->observation.spec),
      .accounts = explain::accounts_of(flight.circumstances(explain::Baseline::kCentre), flight.journal.decisions)};
  std::vector<BeliefPicture> pictures;
  for (const explain::DecisionAccount& account : explanation.accounts)
    pictures.push_back(
        {.account = account, .measurements = std::span(flight.journal.decisions).first(pictures.size() + 1), .source = flight.source});
  explanation.charts = belief_svgs(pictures);
  return explanation;
} catch (const NothingToExplain& e) {
  return {.why_not = e.what()};
} catch (const host::BadInput& e) {
  return {.why_not = e.what(), .is_incomplete = true};
}

std::string page(const Flight& flight, const Pictures& pictures, const FlightExplanation& explanation) {
  std::string text =
      html_head("Earshot: one search") + headline(flight, explanation.uses_measurements) + facts(flight) + shortcomings(flight);
  if (flight.sea)
    text += "<h2>What happened</h2>\n" + sea_events(*flight.sea);
  else if (!flight.events.empty())
    text += "<h2>What happened</h2>\n<p>" + std::string(kOrdersOfASimulation) + "</p>\n" + events_table(flight.events);
  if (!pictures.map.empty())
    text += "<h2>Where it went</h2>\n<p>" + map_to_string(flight) + "</p>\n<div class=\"chart\">" + pictures.map + "</div>\n";
  if (!pictures.sound.empty())
    text += "<h2>What it heard</h2>\n<p>" + sound_to_string(flight) + "</p>\n<div class=\"chart\">" + pictures.sound + "</div>\n";
  if (!pictures.history.empty())
    text += (pictures.sound.empty() ? "<h2>What it heard</h2>\n" : "<h2>What was there to hear</h2>\n") + history_to_string(flight) +
            "<div class=\"chart\">" + pictures.history + "</div>\n";
  text += "<h2>What it decided, and why</h2>\n" + decisions(flight, explanation);
  return text + std::string(kHtmlEnd);
}

}  // namespace earshot::report
