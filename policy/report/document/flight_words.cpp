#include "policy/report/document/flight_words.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>

#include "firmware/host/journal/words/wording.hpp"
#include "firmware/host/text/duration.hpp"
#include "firmware/host/text/numbers.hpp"
#include "policy/explain/wording.hpp"
#include "sim/search/account/search_account.hpp"

namespace earshot::report {
namespace {

using explain::fixed;
using messages::EndReason;
using messages::MissionState;

constexpr const char* kMeasuredAlone =
    "It measured the SNR at its own place, and nothing more: it never saw where the source is, nor the true SNR anywhere else.";
constexpr const char* kMeasuredInVain =
    "Its policy goes by the vehicle's place and steps alone, and uses no measurement. It never saw where the source is.";
constexpr const char* kOrdersOfASimulation =
    "The simulator gave the orders: START, COMPLETE once the vehicle was within a step length of the source, ABORT where the flight was "
    "stopped.";

bool is_simulated(const FlightSources& flight) {
  return !flight.files.summary.is_null();
}

/// The account of a summary; an earlier version's does not have the rule that ended the flight, but its journal does.
search::SearchAccount account_of(const FlightSources& flight) {
  search::SearchAccount account = search::account_in(flight.files.summary);
  if (account.ending_rule.empty() && flight.by_journal && flight.by_journal->ending_rule)
    account.ending_rule = *flight.by_journal->ending_rule;
  return account;
}

FlightVerdict verdict_of_vehicle(const SeaFlight& flight, bool is_being_written) {
  const std::string steps = host::counted(flight.steps_taken, "step");
  if (flight.state == MissionState::kStandby)
    return {is_being_written ? "Waiting for its START" : "A flight without a search: nobody started it"};
  if (flight.state == MissionState::kSearch)
    return {is_being_written ? "Searching: " + steps + " taken" : "The journal ends in mid-search, after " + steps};
  // Of what the vehicle declared nobody at sea knows better.
  const bool is_found = flight.end_reason == EndReason::kCompleted || flight.end_reason == EndReason::kFound;
  const std::string what = flight.state == MissionState::kAbort ? "aborted" : "ended";
  return {"Search " + what + " after " + steps + ": " + flight.why_it_ended() + (flight.ending_rule ? ": " + *flight.ending_rule : ""),
          is_found};
}

std::string program_to_string(const JournalledSearch& journal) {
  if (!journal.closing) return "";
  switch (journal.closing->ending) {
    case messages::Ending::kMissionOver:
      return "earshotd ended with its mission.";
    case messages::Ending::kStopped:
      return "earshotd was stopped by a signal, and ended in order.";
    case messages::Ending::kClockLost:
      return "earshotd lost its simulator.";
  }
  return "";
}

/// A rule or an order may end the mission within a step: its decision was taken, the step was not.
std::string unfinished_step(const FlightSources& flight) {
  const std::size_t decisions = flight.journal.decisions.size();
  if (decisions != flight.files.summary.at("steps").get<std::size_t>() + 1) return "";
  return "The mission ended within the step of the last of " + std::to_string(decisions) + " decisions, which does not count.";
}

/// The flight's summary counts a step that the source cut short as the others: one count, with a word about the last.
std::vector<std::string> sentences_of_simulator(const FlightSources& flight) {
  const nlohmann::json& s = flight.files.summary;
  const auto steps = s.at("steps").get<std::uint64_t>();
  const search::SearchAccount account = account_of(flight);
  const std::string end = search::end_to_string(account);
  const bool is_in_verdict = account.is_found || search::verdict_on(account).text.find(end) != std::string::npos;
  return {is_in_verdict ? "" : "The mission ended after " + host::counted(steps, "step") + ": " + end + ".",
          std::string(kSimulationNote) + " " + (flight.uses_measurements ? kMeasuredAlone : kMeasuredInVain),
          unfinished_step(flight),
          s.value("whole_steps", steps) < steps ? "The last step was cut short by the source." : "",
          search::to_string(account),
          kOrdersOfASimulation,
          s.contains("hearing") ? "It measured the SNR in sound. For the first " + fixed(s.at("hearing").at("search_began_s"), 0) +
                                      " s it lay at its start, to learn the noise of the sea."
                                : ""};
}

std::vector<std::string> sentences_of_vehicle(const FlightSources& flight) {
  const SeaFlight& sea = *flight.by_journal;
  return {sea.is_dated() ? "The journal begins at " + journal::utc(sea.began) + "; every time is counted from there."
                         : "The journal's clock begins with the flight: it was a simulation, and no vehicle was at sea.",
          program_to_string(flight.journal),
          flight.journal.is_whole() ? "The journal is whole: it was ended in order, and no record of it was lost." : "",
          sea.safety_record ? "What stands beside the journal: " + *sea.safety_record : "",
          search::to_string(sea.account),
          sea.build.empty() ? "" : "Flown by earshotd " + sea.build + "."};
}

std::vector<Condition> facts_of_simulator(const FlightSources& flight) {
  const nlohmann::json& s = flight.files.summary;
  const search::SearchAccount account = account_of(flight);
  const double sim = s.at("sim_time_s");
  const double wall = s.at("wall_time_s");
  std::vector<Condition> facts = listed(conditions_in(s));
  facts.push_back({"reward", fixed(s.at("reward"), 1), search::kRewardMeans});
  facts.push_back({"detections", std::to_string(s.at("detections").get<int>()), search::detection_means(s.at("detection_threshold_db"))});
  facts.push_back({"found", search::verdict_on(account).is_found ? "yes" : "no", search::found_means(account.step_length_m)});
  if (account.believes || account.declared_step)  // a policy without a belief has no rule that could declare anything
    facts.push_back(
        {"declared", account.declared_step ? "at step " + std::to_string(*account.declared_step) : "no", search::kDeclaredMeans});
  facts.push_back({"distance", fixed(s.at("distance_m").get<double>() / 1e3, 1) + " km"});
  if (s.contains("battery_percent")) facts.push_back({"battery left", fixed(s.at("battery_percent"), 1) + " %"});
  facts.push_back(
      {"time at sea", host::duration(sim),
       "in simulated time; computed in " + fixed(wall, 2) + " s, " + (wall > 0 ? fixed(sim / wall, 0) : "-") + " times real time"});
  facts.push_back({"seed", std::to_string(s.at("seed").get<std::uint64_t>())});
  facts.push_back({"mission", s.at("mission").get<std::string>()});
  facts.push_back({"ocean", s.at("environment").get<std::string>()});
  return facts;
}

std::vector<Condition> facts_of_vehicle(const FlightSources& sources) {
  const SeaFlight& flight = *sources.by_journal;
  const std::vector<explain::RecordedDecision>& decisions = sources.journal.decisions;
  const messages::Counters& refused = flight.counters;
  std::vector<Condition> facts{{"frequency searched for", fixed(flight.frequency.value, 1) + " Hz"},
                               {"depth of the search", fixed(flight.depth.value, 0) + " m"},
                               {"speed of the search", fixed(flight.speed.value, 1) + " m/s"},
                               {"time in the journal", host::duration(flight.ended_s)}};
  if (flight.search_began_s) {
    facts.push_back({"of it searching", host::duration(flight.search_ended_s.value_or(flight.ended_s) - *flight.search_began_s)});
    facts.push_back({"sailed in the search", fixed(flight.sailed.value / 1e3, 1) + " km"});
  }
  facts.push_back({"decisions", std::to_string(decisions.size())});
  facts.push_back({"detections", std::to_string(std::ranges::count_if(decisions, &explain::RecordedDecision::detected)),
                   search::detection_means(flight.threshold.value)});
  facts.push_back({"loudest SNR", flight.loudest_db ? fixed(*flight.loudest_db, 1) + " dB" : "-"});
  facts.push_back({"fixes", std::to_string(flight.fixes)});
  facts.push_back({"SNR measurements", std::to_string(flight.measurements)});
  facts.push_back({"refused",
                   "fixes " + std::to_string(refused.navigation_refused) + ", SNR " + std::to_string(refused.snr_refused) + ", bearings " +
                       std::to_string(refused.bearings_refused) + " and " + std::to_string(refused.bearings_of_others) +
                       " of a second sender, commands " + std::to_string(refused.commands_refused),
                   "as they came in"});
  return facts;
}

std::string missing_files(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "Not there: " : ", ") + name;
  return text.empty() ? "" : text + ". A simulator that is stopped at sea does not write them; this page is of the rest.";
}

std::vector<std::string> without_empty(std::vector<std::string> sentences) {
  std::erase_if(sentences, [](const std::string& sentence) { return sentence.empty(); });
  return sentences;
}

}  // namespace

FlightVerdict verdict_on(const FlightSources& flight) {
  if (is_simulated(flight)) {
    const search::Verdict verdict = search::verdict_on(account_of(flight));
    return {verdict.text, verdict.is_found};
  }
  if (flight.by_journal) return verdict_of_vehicle(*flight.by_journal, flight.is_being_written);
  return {flight.is_being_written ? "Waiting for its mission" : "A flight without its end"};
}

std::vector<std::string> sentences_on(const FlightSources& flight) {
  std::vector<std::string> all;
  if (is_simulated(flight))
    all = sentences_of_simulator(flight);
  else if (flight.by_journal)
    all = sentences_of_vehicle(flight);
  return without_empty(std::move(all));
}

std::vector<Condition> facts_of(const FlightSources& flight) {
  if (is_simulated(flight)) return facts_of_simulator(flight);
  return flight.by_journal ? facts_of_vehicle(flight) : std::vector<Condition>{};
}

std::vector<std::string> shortcomings_of(const FlightSources& flight) {
  return without_empty({missing_files(flight.files.missing), flight.is_being_written ? "" : lack_of(flight.journal),
                        flight.unexplained.empty() ? "" : "Not explained: " + flight.unexplained});
}

}  // namespace earshot::report
