#include "policy/report/sea_page.hpp"

#include <algorithm>

#include "firmware/host/journal/words/wording.hpp"
#include "firmware/host/text/duration.hpp"
#include "firmware/host/text/numbers.hpp"
#include "policy/explain/wording.hpp"
#include "policy/report/html.hpp"
#include "sim/search/account/search_account.hpp"

namespace earshot::report {
namespace {

using explain::fixed;
using messages::Ending;
using messages::MissionState;

std::string ending_to_string(const SeaFlight& flight) {
  const std::string steps = host::counted(flight.steps_taken, "step");
  switch (flight.state) {
    case MissionState::kStandby:
      return "<h1>A flight without a search: nobody started it</h1>\n";
    case MissionState::kSearch:
      return "<h1 class=\"missed\">The journal ends in mid-search, after " + steps + "</h1>\n";
    case MissionState::kDone:
    case MissionState::kAbort:
      break;
  }
  // Of what the vehicle declared nobody at sea knows better.
  const bool is_found = flight.end_reason == messages::EndReason::kCompleted || flight.end_reason == messages::EndReason::kFound;
  const std::string what = flight.state == MissionState::kAbort ? "aborted" : "ended";
  return "<h1 class=\"" + std::string(is_found ? "found" : "missed") + "\">Search " + what + " after " + steps + ": " +
         flight.why_it_ended() + (flight.ending_rule ? ": " + escaped(*flight.ending_rule) : "") + "</h1>\n";
}

std::string program_to_string(const JournalledSearch& journal) {
  if (!journal.closing) return "";
  switch (journal.closing->ending) {
    case Ending::kMissionOver:
      return "earshotd ended with its mission.";
    case Ending::kStopped:
      return "earshotd was stopped by a signal, and ended in order.";
    case Ending::kClockLost:
      return "earshotd lost its simulator.";
  }
  return "";
}

}  // namespace

std::string sea_headline(const SeaFlight& flight, const JournalledSearch& journal) {
  std::string text = ending_to_string(flight) + "<p>";
  if (flight.is_dated())
    text += "The journal begins at <b>" + journal::utc(flight.began) + "</b>; every time on this page is counted from there. ";
  else
    text += "The journal's clock begins with the flight: it was a simulation, and no vehicle was at sea. ";
  text += escaped(program_to_string(journal)) + "</p>\n";
  if (journal.is_whole()) text += "<p>The journal is whole: it was ended in order, and no record of it was lost.</p>\n";
  if (flight.safety_record) text += "<p>What stands beside the journal: " + escaped(*flight.safety_record) + "</p>\n";
  return text + (flight.build.empty() ? "" : "<p>Flown by earshotd " + escaped(flight.build) + "</p>\n");
}

std::string sea_facts(const SeaFlight& flight, const JournalledSearch& journal) {
  const auto detections = std::ranges::count_if(journal.decisions, [](const explain::RecordedDecision& d) { return d.detected; });
  const auto is_fainter = [](const SeaFlight::Measurement& a, const SeaFlight::Measurement& b) { return a.snr_db < b.snr_db; };
  std::vector<SeaFlight::Measurement> measured = flight.measurements;
  std::erase_if(measured, [](const SeaFlight::Measurement& one) { return one.too_faint; });
  const auto loudest = std::ranges::max_element(measured, is_fainter);
  std::string text = "<dl>\n" + fact("frequency searched for", fixed(flight.frequency.value, 1) + " Hz") +
                     fact("depth of the search", fixed(flight.depth.value, 0) + " m") +
                     fact("speed of the search", fixed(flight.speed.value, 1) + " m/s") +
                     fact("time in the journal", host::duration(flight.ended_s));
  if (flight.search_began_s)
    text += fact("of it searching", host::duration(flight.search_ended_s.value_or(flight.ended_s) - *flight.search_began_s)) +
            fact("sailed in the search", fixed(flight.distance().value / 1e3, 1) + " km");
  text += fact("decisions", std::to_string(journal.decisions.size())) +
          fact("detections", std::to_string(detections), search::detection_means(flight.threshold.value)) +
          fact("loudest SNR", loudest == measured.end() ? "-" : fixed(loudest->snr_db, 1) + " dB");
  return text + fact("fixes", std::to_string(flight.fixes.size())) + fact("SNR measurements", std::to_string(flight.measurements.size())) +
         "</dl>\n";
}

std::string events_table(std::span<const SeaFlight::Event> events) {
  std::string text =
      "<div class=\"table\"><table class=\"events\">\n<thead><tr><th>at</th><th class=\"left\">what</th></tr></thead>\n<tbody>\n";
  for (const SeaFlight::Event& event : events)
    text += "<tr><td>" + host::duration(event.time_s) + "</td><td class=\"left\">" + escaped(event.what) + "</td></tr>\n";
  return text + "</tbody></table></div>\n";
}

std::string sea_events(const SeaFlight& flight) {
  const std::string text =
      flight.events.empty() ? "<p>No order came, and the mission stayed in STANDBY.</p>\n" : events_table(flight.events);
  const messages::Counters& refused = flight.counters;
  return text + "<p>Refused as they came in: fixes " + std::to_string(refused.navigation_refused) + ", SNR " +
         std::to_string(refused.snr_refused) + ", bearings " + std::to_string(refused.bearings_refused) + " and " +
         std::to_string(refused.bearings_of_others) + " of a second sender, commands " + std::to_string(refused.commands_refused) +
         ".</p>\n";
}

}  // namespace earshot::report
