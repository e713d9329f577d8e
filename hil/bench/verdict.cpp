#include "hil/bench/verdict.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <csignal>
#include <numeric>
#include <span>
#include <sstream>
#include <string_view>
#include <variant>

#include "firmware/boards/linux/replay/replay.hpp"
#include "firmware/core/math.hpp"
#include "firmware/core/overloads.hpp"
#include "firmware/host/file/bad_input.hpp"
#include "firmware/host/journal/reading/record_source.hpp"
#include "firmware/host/program/exit_status.hpp"
#include "firmware/messages/dictionary/health_words.hpp"
#include "firmware/safety/fence.hpp"
#include "hil/bench/vehicle_bus.hpp"

namespace earshot::hil {
namespace {

constexpr std::size_t kMostComplaints = 5;
constexpr Meters kSettling{25.0};  ///< a vehicle that dives to its limit may overshoot it so far before its rule acts

std::string at(Time time) {
  std::ostringstream text;
  text << " at " << static_cast<double>(time.us) / 1e6 << " s";
  return text.str();
}

MetersPerSecond fastest(const config::Mission& mission) {
  return std::max({mission.search_speed, mission.safety.vehicle.hold_speed, mission.safety.vehicle.ascent_speed});
}

void judge(const messages::Setpoint& setpoint, Time time, const config::Mission& mission, std::vector<std::string>& complaints) {
  const bool is_number =
      std::isfinite(setpoint.heading.value) && std::isfinite(setpoint.speed.value) && std::isfinite(setpoint.depth.value);
  const bool is_within = is_number && setpoint.speed >= MetersPerSecond{0.0} && setpoint.speed <= fastest(mission) &&
                         setpoint.depth >= Meters{0.0} && setpoint.depth <= mission.max_depth;
  if (is_within || complaints.size() >= kMostComplaints) return;
  std::ostringstream text;
  text << "a set-point beyond the limits" << at(time) << ": " << setpoint.depth.value << " m, " << setpoint.speed.value << " m/s";
  complaints.push_back(text.str());
}

Time since(Time began, Time time) {
  return Time{} + (time - began);
}

void note(const messages::Health& health, JournalFindings& found) {
  found.end = health.end_reason;
  found.counters.navigation_refused = health.counters.navigation_refused;
  found.counters.commands_refused = health.counters.commands_refused;
  for (const messages::PortReport& port : health.ports) found.lost.at(port.port) = port.lost;
}

void note(const journal::Record& record, const config::Mission& mission, Time began, JournalFindings& found) {
  std::visit(Overloads{[&](const messages::Health& health) { note(health, found); },
                       [&](const messages::ControllerTrouble& trouble) { found.troubles.push_back(trouble); },
                       [&](const messages::Decision& /*decision*/) { found.decisions.push_back(since(began, record.time)); },
                       [&](const messages::SafetyEvent& event) {
                         found.events.push_back(event);
                         found.events.back().time = since(began, event.time);
                       },
                       [&](const messages::Setpoint& setpoint) {
                         ++found.setpoints;
                         judge(setpoint, since(began, record.time), mission, found.beyond_limits);
                       },
                       Unheeded<journal::Unreadable, journal::PolicyBytes, journal::TablesBytes, messages::MissionRecord, messages::Input,
                                messages::CommandAcknowledgement, messages::ClosingRecord, messages::JournalResumed,
                                messages::SoundDetection, messages::PublishedChallenge>{}},
             record.content);
}

/// Until the first fault begins nothing may have fired.
Time first_fault(const Case& c) {
  const auto first = std::ranges::min_element(c.faults, {}, &TimedFault::from);
  return first == c.faults.end() ? Time{} : first->from;
}

void judge_rules(const Case& c, const JournalFindings& journal, std::vector<std::string>& wrong) {
  for (const config::Condition rule : c.expected.rules) {
    const bool has_fired = std::ranges::any_of(journal.events, [&](const messages::SafetyEvent& event) {
      return event.begins && event.condition == rule && event.time >= first_fault(c);
    });
    if (!has_fired) wrong.push_back("the rule " + key_of(rule) + " did not fire");
  }
  if (!c.expected.only_these) return;
  for (const messages::SafetyEvent& event : journal.events) {
    if (!event.begins || std::ranges::find(c.expected.rules, event.condition) != c.expected.rules.end()) continue;
    wrong.push_back("the rule " + key_of(event.condition) + " fired" + at(event.time));
    return;
  }
}

/// Earshot must have noticed what hit its controller and its hydrophone, though it went on.
void judge_notice(const Case& c, const JournalFindings& journal, std::vector<std::string>& wrong) {
  for (const TimedFault& fault : c.faults) {
    const auto reports = [&](bool begins) {
      const auto state = fault.fault == Fault::kBusOff ? messages::ControllerState::kBusOff : messages::ControllerState::kErrorPassive;
      return std::ranges::any_of(journal.troubles, [&](const messages::ControllerTrouble& trouble) {
        return trouble.trouble == state && trouble.is_there == begins;
      });
    };
    const bool is_controllers = fault.traits().hits == FaultTarget::kController;
    if (is_controllers && !reports(true)) wrong.push_back("the journal does not report that it began: " + to_string(fault));
    if (is_controllers && fault.until && !reports(false)) wrong.push_back("the journal does not report that it ended: " + to_string(fault));
    if (fault.fault == Fault::kSoundDropout && fault.until && journal.lost.at(c.sound_port) == 0)
      wrong.emplace_back("the journal does not report that samples were lost");
  }
}

void judge_refusals(std::optional<bool> wanted, std::uint64_t count, const std::string& what, std::vector<std::string>& wrong) {
  if (wanted == true && count == 0) wrong.push_back("no " + what + " was refused");
  if (wanted == false && count > 0) wrong.push_back("refused, though none may be: " + what + ", " + std::to_string(count) + " times");
}

void judge_track(const config::Mission& mission, const BenchFlight& flight, std::vector<std::string>& wrong) {
  const auto& halt = mission.safety.fence;
  for (const TruePlace& place : flight.track) {
    const bool is_in = halt ? safety::beyond(halt->halt, place.position) <= Meters{0.0} : mission.operating_area.contains(place.position);
    if (!is_in) return wrong.push_back("the vehicle was beyond the halt polygon" + at(place.time));
    if (!(place.depth <= mission.max_depth + kSettling)) return wrong.push_back("the vehicle was too deep" + at(place.time));
  }
}

/// A fault that did nothing tests nothing, whatever came of the flight.
void judge_faults(const Case& c, const BenchFlight& flight, std::vector<std::string>& wrong) {
  if (!flight.failure.empty()) return;
  for (const TimedFault& fault : flight.idle) wrong.push_back("the fault never acted: " + to_string(fault));
  if (flight.idle.empty() && c.has(FaultTarget::kFrames) && flight.afflicted == 0) wrong.emplace_back("no frame met the fault");
}

/// Whether what is not in the journal is no fault of Earshot's.
bool loses_journal(const Case& c) {
  return c.has(Fault::kFullDisk) || c.has(Fault::kReadOnlyDisk) || c.has(Fault::kFlippedBit);
}

/// Of one that a case stopped or killed too.
bool is_in_order(int status, const Case& c) {
  if (status == program::kDone || status == program::kAborted || status == program::kInterrupted) return true;
  constexpr int kKilled = 128 + SIGKILL;
  const bool is_killed = std::ranges::any_of(
      c.faults, [](const TimedFault& fault) { return fault.fault == Fault::kKill && fault.device != kVehiclesProgram; });
  return (status == kKilled && (is_killed || c.has(Fault::kPowerCut))) || (status == program::kLost && loses_journal(c));
}

}  // namespace

JournalFindings read_findings(const std::filesystem::path& journal, const config::Mission& mission, Time began) {
  JournalFindings found;
  try {
    journal::for_each_record(journal, [&](const journal::Record& record) { note(record, mission, began, found); });
    const board::ReplayResult again = board::replay(journal);
    found.is_same_again = again.is_same();
    if (again.difference) found.difference = "record " + std::to_string(again.difference->record) + " (" + again.difference->channel + ")";
    if (again.gap) found.difference = "records are missing from number " + std::to_string(*again.gap) + " on";
  } catch (const std::exception& e) {
    found.trouble = e.what();
  }
  return found;
}

bool is_beyond_command(const TimedFault& fault, const config::Mission& mission) {
  if (fault.fault == Fault::kCurrent && fault.amount <= mission.safety.vehicle.max_current.value) return false;
  constexpr std::array kBeyond{Fault::kRudderStuck, Fault::kPlanesStuck,      Fault::kNoThrust, Fault::kDisengaged,
                               Fault::kObstinate,   Fault::kCurrent,          Fault::kFrozen,   Fault::kPositionError,
                               Fault::kDepthError,  Fault::kSecondNavigation, Fault::kReplay};
  return std::ranges::find(kBeyond, fault.fault) != kBeyond.end();
}

std::vector<std::string> broken_promises(const Case& c, const config::Mission& mission, const BenchFlight& flight,
                                         const JournalFindings& journal) {
  std::vector<std::string> wrong;
  if (!flight.failure.empty()) wrong.push_back(flight.failure);
  if (c.expected.refuses_to_fly) {
    if (flight.exit_statuses != std::vector{program::kBadInput}) wrong.emplace_back("earshotd did not refuse to fly");
    return wrong;
  }
  for (std::size_t i = 0; i < flight.exit_statuses.size(); ++i) {
    const bool has_words = i + 1 == flight.exit_statuses.size() && !flight.last_words.empty();
    if (!is_in_order(flight.exit_statuses[i], c))
      wrong.push_back("earshotd ended with status " + std::to_string(flight.exit_statuses[i]) +
                      (has_words ? ": " + flight.last_words : ""));
  }
  if (!journal.trouble.empty()) wrong.push_back("the journal cannot be read: " + journal.trouble);
  if (!journal.is_same_again && !loses_journal(c) && journal.trouble.empty())
    wrong.push_back("the journal is not given again: " + journal.difference);
  wrong.insert(wrong.end(), journal.beyond_limits.begin(), journal.beyond_limits.end());
  if (std::ranges::none_of(c.faults, [&](const TimedFault& fault) { return is_beyond_command(fault, mission); }))
    judge_track(mission, flight, wrong);
  return wrong;
}

std::vector<std::string> unmet_expectations(const Case& c, const BenchFlight& flight, const JournalFindings& journal) {
  std::vector<std::string> wrong;
  // One that is under way when its time is up is then told to stop, and the journal says so.
  const bool is_reported = c.expected.end == messages::EndReason::kNone && journal.end == messages::EndReason::kOperatorAbort;
  const bool is_journalled = flight.end != messages::EndReason::kOutage;  // who brings the vehicle up then needs none, and writes none
  if (!loses_journal(c) && !is_reported && is_journalled && flight.end != journal.end)
    wrong.emplace_back("the journal has another end than earshotd's last answer");
  if (flight.end != c.expected.end)
    wrong.push_back(std::string("the mission ended otherwise: ") + messages::to_string(flight.end) +
                    ", not: " + messages::to_string(c.expected.end));
  judge_rules(c, journal, wrong);
  judge_notice(c, journal, wrong);
  wrong.insert(wrong.end(), flight.uncounted.begin(), flight.uncounted.end());
  judge_refusals(c.expected.refuses_navigation, journal.counters.navigation_refused, "fix", wrong);
  judge_refusals(c.expected.refuses_commands, journal.counters.commands_refused, "order", wrong);
  const std::uint64_t lost = std::accumulate(journal.lost.begin(), journal.lost.end(), std::uint64_t{0});
  if (c.expected.loses_nothing && lost > 0) wrong.push_back("lost on their way in: " + std::to_string(lost) + " frames");
  const auto decisions = std::ranges::count_if(journal.decisions, [from = first_fault(c)](Time time) { return time >= from; });
  if (decisions < c.expected.decisions)
    wrong.push_back("decisions after the first fault: " + std::to_string(decisions) + ", not " + std::to_string(c.expected.decisions));
  if (c.expected.comes_up && (flight.track.empty() || flight.track.back().depth > kAtSurface))
    wrong.emplace_back("the vehicle did not come up");
  if (c.expected.releases_weight && !flight.is_weight_released) wrong.emplace_back("the weight was not released");
  judge_faults(c, flight, wrong);
  if (c.expected.refuses_frames && flight.refused == 0) wrong.emplace_back("the kernel had room for every frame");
  return wrong;
}

}  // namespace earshot::hil
