#include "firmware/runtime/runtime.hpp"

#include <algorithm>
#include <cassert>
#include <memory>
#include <span>
#include <type_traits>
#include <variant>

#include "firmware/authority/tightened.hpp"
#include "firmware/core/math.hpp"
#include "firmware/policy/check/policy_check.hpp"
#include "firmware/policy/format/policy_format.hpp"
#include "firmware/policy/tables/tables_format.hpp"
#include "firmware/runtime/bytes_of_state.hpp"
#include "firmware/runtime/known_steps.hpp"
#include "firmware/safety/check.hpp"
#include "firmware/safety/limits.hpp"

namespace earshot::runtime {
namespace {

using messages::CommandOutcome;
using messages::EndReason;
using messages::MissionState;
using messages::Order;

/// Whether a message dated `time` may follow one dated `last`. One dated long before its arrival is a recording or comes from a stalled
/// queue; one from far ahead would pass for fresh long after its sender fell silent.
bool is_in_order(Time time, Time last, Time arrival, Duration timeout) {
  return time >= last && lies_within(time, arrival, timeout);
}

/// A date ahead of its arrival counts as the arrival: a sender whose clock is fast neither hides those that come after it nor stays fresh
/// for longer.
Time effective(Time date, Time arrival) {
  return date < arrival ? date : arrival;
}

/// Of vehicle, autopilot and hydrophone; what is older is told by the rules about its age.
constexpr Duration kStatusMaxAge = Duration::seconds(30);

EndReason end_reason_of(config::Condition cause) {
  switch (cause) {
    case config::Condition::kNavigationAge:
      return EndReason::kNavigationStale;
    case config::Condition::kSnrAge:
      return EndReason::kSnrStale;
    case config::Condition::kOutsideHalt:
      return EndReason::kLeftOperatingArea;
    case config::Condition::kSearchTime:
      return EndReason::kTimeUsedUp;
    default:
      return EndReason::kSafetyRule;
  }
}

}  // namespace

void Runtime::forget() {
  configured_ = false;
  static_assert(std::is_trivially_destructible_v<Progress>);
  std::construct_at(&progress_);  // where it is: another would take most of a microcontroller's stack
  integrity_ = kIntact;
  seal_mission();
  seal();
}

Status Runtime::judge_search(const config::Mission& mission, const policy::FrozenPolicy& policy) {
  if (policy::mismatch(policy, mission) != policy::Mismatch::kNone) return Status::kOutOfRange;
  return repeats_known_steps() && policy::repeats_golden(policy, memory_, tables_) ? Status::kOk : Status::kCorrupt;
}

void Runtime::arm(const config::Mission& mission) {
  mission_ = mission;
  progress_.random = Pcg32(mission.action_seed);
  progress_.judge = authority::CommandJudge(mission.authority.needs_verified_commands);
  progress_.situation.navigation = safety::NavigationJudge(mission.safety.vehicle, mission.navigation_timeout);
  progress_.supervisor.configure(mission_);
  configured_ = true;
  policy_checksum_ = checksum_of(policy_);
  tables_checksum_ = checksum_of(tables_);
  seal_mission();
  seal();
}

Status Runtime::configure(const config::Mission& mission, const policy::FrozenPolicy& policy, const policy::OceanTables& tables) {
  forget();
  if (const Status status = config::check(mission); status != Status::kOk) return status;
  if (!safety::check(mission).is_none()) return Status::kOutOfRange;
  if (const policy::PolicyComplaint complaint = policy::check(policy); !complaint.is_none()) return policy::status_of(complaint.fault);
  const bool needs_tables = policy::needs_belief(policy.observation.spec);
  if (needs_tables && !policy::are_usable(tables, policy::searched_sound(mission))) return Status::kOutOfRange;
  if (const Status status = judge_search(mission, policy); status != Status::kOk) return status;
  policy_ = policy;
  tables_.tables.clear();
  if (needs_tables) tables_ = tables;
  arm(mission);
  return Status::kOk;
}

Status Runtime::configure(const config::Mission& mission, std::span<const std::uint8_t> policy, std::span<const std::uint8_t> tables) {
  forget();
  if (const Status status = config::check(mission); status != Status::kOk) return status;
  if (!safety::check(mission).is_none()) return Status::kOutOfRange;
  policy::PolicyComplaint complaint;
  if (const Status status = policy::parse(policy, policy_, complaint); status != Status::kOk) return status;
  if (const Status status = judge_search(mission, policy_); status != Status::kOk) return status;
  tables_.tables.clear();
  if (policy::needs_belief(policy_.observation.spec)) {
    if (const Status status = policy::parse(tables, tables_, complaint); status != Status::kOk) return status;
    if (!policy::are_usable(tables_, policy::searched_sound(mission))) return Status::kOutOfRange;
  }
  arm(mission);
  return Status::kOk;
}

void Runtime::turn(Time now, Outputs& outputs) {
  ++progress_.turn;
  const bool is_ready = navigation_is_fresh(now) && snr_is_fresh(now) && autopilot_is_connected(now);
  if (progress_.state == MissionState::kStandby && progress_.command.is_search_ordered(now) && is_ready) begin_search(now);
  if (progress_.state == MissionState::kSearch) {
    search(now, outputs);
  } else if (progress_.command.is_engaged()) {
    watch_for_release(now, outputs);
  }
  outputs.setpoint = setpoint(now);
  outputs.acknowledgements = progress_.acknowledgements;
  progress_.acknowledgements.clear();
  outputs.health = health(now);
}

messages::CommandOutcome Runtime::judge(const messages::Input& input) {
  CommandOutcome outcome = CommandOutcome::kObeyed;
  if (const auto* navigation = std::get_if<messages::Navigation>(&input.value)) take(input.arrival, input.port, *navigation);
  if (const auto* measurement = std::get_if<messages::SnrMeasurement>(&input.value)) take(input.arrival, *measurement);
  if (const auto* bearing = std::get_if<messages::BearingMeasurement>(&input.value)) take(input.arrival, input.port, *bearing);
  if (const auto* command = std::get_if<messages::OperatorCommand>(&input.value))
    outcome = take_command(input.arrival, input.port, *command);
  if (const auto* report = std::get_if<messages::PortReport>(&input.value)) take(*report);
  if (std::holds_alternative<messages::UnsentSetpoints>(input.value)) progress_.is_mute = true;
  safety::Situation& situation = progress_.situation;
  if (const auto* status = std::get_if<messages::VehicleStatus>(&input.value)) take(input.arrival, input.port, *status);
  if (const auto* status = std::get_if<messages::AutopilotStatus>(&input.value))
    (void)take_status(input.arrival, *status, situation.autopilot);
  if (const auto* status = std::get_if<messages::HydrophoneStatus>(&input.value))
    (void)take_status(input.arrival, *status, situation.hydrophone);
  return outcome;
}

void Runtime::take(Time arrival, std::uint8_t port, const messages::Navigation& navigation) {
  safety::Situation& situation = progress_.situation;
  const bool is_to_move = situation.commanded && situation.commanded->speed.value > 0.0;
  if (situation.navigation.is_anothers(port, arrival)) return situation.navigation.compare(arrival, navigation);
  if (!situation.navigation.take(arrival, navigation, is_to_move)) {
    ++progress_.counters.navigation_refused;
    return;
  }
  situation.navigation.hold(port, arrival);
  const messages::Navigation& fix = *situation.navigation.newest();
  situation.depth.take(fix);
  if (!is_to_move || situation.depth.is_left_alone(arrival)) {
    situation.place.begin(fix);
  } else if (situation.navigation.newest_is_correction()) {
    situation.place.correct(fix);
  } else {
    situation.place.take(fix, *situation.commanded, mission_.safety.vehicle);
  }
  if (progress_.state == MissionState::kSearch && situation.navigation.newest_is_correction()) {
    situation.track.correct(*situation.navigation.newest());
  } else if (progress_.state == MissionState::kSearch) {
    situation.track.take(*situation.navigation.newest());
  }
}

template <class Status>
bool Runtime::take_status(Time arrival, const Status& status, std::optional<Status>& newest) {
  if (!is_in_order(status.time, newest ? newest->time : Time{}, arrival, kStatusMaxAge)) {
    ++progress_.counters.status_refused;
    return false;
  }
  newest = status;
  newest->time = effective(status.time, arrival);
  return true;
}

/// An alarm counts also where another sender, whose clock is ahead, has hidden what it says.
void Runtime::take(Time arrival, std::uint8_t port, const messages::VehicleStatus& status) {
  safety::Situation& situation = progress_.situation;
  const bool is_newest = take_status(arrival, messages::usable_part_of(status), situation.vehicle);
  if (!situation.vehicle || !lies_within(status.time, arrival, kStatusMaxAge)) return;
  if (is_newest || status.has_leak) situation.leak.take(arrival, port, status.has_leak);
  if (is_newest || status.has_ground_fault) situation.ground_fault.take(arrival, port, status.has_ground_fault);
  hold_alarms();
}

void Runtime::hold_alarms() {
  safety::Situation& situation = progress_.situation;
  if (!situation.vehicle) return;
  situation.vehicle->has_leak = situation.leak.stands();
  situation.vehicle->has_ground_fault = situation.ground_fault.stands();
}

void Runtime::take(Time arrival, const messages::SnrMeasurement& measurement) {
  const Time last = progress_.listener.newest() ? progress_.listener.newest()->time : Time{};
  if (messages::is_possible_snr(measurement.snr) && is_in_order(measurement.time, last, arrival, mission_.snr_timeout)) {
    progress_.listener.take({.time = effective(measurement.time, arrival), .snr = measurement.snr, .too_faint = measurement.too_faint});
  } else {
    ++progress_.counters.snr_refused;
  }
}

void Runtime::take(Time arrival, std::uint8_t port, const messages::BearingMeasurement& measurement) {
  using Verdict = detector::BearingListener::Verdict;
  const Verdict verdict = progress_.bearings.take(arrival, port, measurement, mission_.snr_timeout);
  if (verdict == Verdict::kRefused) ++progress_.counters.bearings_refused;
  if (verdict == Verdict::kOfAnother) ++progress_.counters.bearings_of_others;
}

void Runtime::take(const messages::PortReport& report) {
  for (messages::PortReport& known : progress_.ports) {
    if (known.port == report.port) {
      known = report;
      return;
    }
  }
  static_cast<void>(progress_.ports.push_back(report));  // a report of a port that cannot be: there is room for each that can
}

CommandOutcome Runtime::take_command(Time arrival, std::uint8_t port, const messages::OperatorCommand& command) {
  using Sender = authority::CommandJudge::Sender;
  const Sender sender = port == messages::kOwnPort ? Sender::kVehicle : Sender::kOperator;
  const authority::CommandJudge::Verdict verdict = progress_.judge.judge(arrival, command, sender);
  if (verdict.is_from_now) progress_.situation.operator_heard = arrival;
  CommandOutcome outcome = verdict.outcome;
  if (!verdict.is_repetition) {
    if (outcome == CommandOutcome::kObeyed) outcome = obey(arrival, command);
    if (outcome != CommandOutcome::kObeyed && outcome != CommandOutcome::kRepeated) ++progress_.counters.commands_refused;
    const bool is_to_be_known = command.order != Order::kAbort && sender == Sender::kOperator;
    if (is_to_be_known && verdict.outcome == CommandOutcome::kObeyed) progress_.judge.remember(command, outcome);
  }
  acknowledge(
      {.time = arrival, .port = port, .issuer = command.issuer, .number = command.number, .order = command.order, .outcome = outcome});
  return outcome;
}

/// When there is no room its sender asks again; but an ABORT takes the place of the last.
void Runtime::acknowledge(const messages::CommandAcknowledgement& acknowledgement) {
  Acknowledgements& waiting = progress_.acknowledgements;
  if (waiting.push_back(acknowledgement) != Status::kOk && acknowledgement.order == Order::kAbort)
    waiting[waiting.size() - 1] = acknowledgement;
}

CommandOutcome Runtime::obey(Time arrival, const messages::OperatorCommand& command) {
  if (command.order == Order::kAbort) {
    if (progress_.state == MissionState::kAbort) return CommandOutcome::kRepeated;
    end(MissionState::kAbort, EndReason::kOperatorAbort);
    return CommandOutcome::kObeyed;
  }
  if (!configured_) return CommandOutcome::kNotConfigured;
  if (command.order == Order::kTighten) return tighten(command.limits);
  if (command.order == Order::kComplete) {
    if (progress_.state != MissionState::kSearch) return CommandOutcome::kNotInThisState;
    ++progress_.steps_taken;  // the step under way ends where the source is
    end(MissionState::kDone, EndReason::kCompleted);
    return CommandOutcome::kObeyed;
  }
  const bool was_engaged = progress_.command.is_engaged();
  const CommandOutcome outcome = progress_.command.obey(command, progress_.state, autopilot_is_connected(arrival));
  if (progress_.command.is_engaged() != was_engaged) progress_.is_interrupted = true;  // what it would have done is not where it is
  return outcome;
}

CommandOutcome Runtime::tighten(const messages::OperatorLimits& limits) {
  if (progress_.state != MissionState::kStandby && progress_.state != MissionState::kSearch) return CommandOutcome::kNotInThisState;
  if (authority::tighten(mission_, limits) != Status::kOk) return CommandOutcome::kNotTighter;
  seal_mission();
  progress_.supervisor.tighten(mission_);
  return CommandOutcome::kObeyed;
}

void Runtime::end(MissionState state, EndReason reason) {
  progress_.state = state;
  progress_.end_reason = reason;
}

bool Runtime::navigation_is_fresh(Time now) const {
  const std::optional<messages::Navigation>& newest = progress_.situation.navigation.newest();
  return newest && now - newest->time <= mission_.navigation_timeout;
}

bool Runtime::snr_is_fresh(Time now) const {
  return progress_.listener.newest() && now - progress_.listener.newest()->time <= mission_.snr_timeout;
}

bool Runtime::autopilot_is_connected(Time now) const {
  return authority::is_connected(mission_.authority, progress_.situation.autopilot, now);
}

std::optional<config::Response> Runtime::response() const {
  const std::optional<config::Response> of_rules = progress_.supervisor.response();
  return progress_.command.is_paused() ? std::max(of_rules, std::optional(config::Response::kHold)) : of_rules;
}

void Runtime::supervise(Time now, Outputs& outputs) {
  safety::Situation& situation = progress_.situation;
  situation.now = now;
  situation.snr = progress_.listener.newest()->time;
  if (!progress_.is_mute) {
    situation.mute_since.reset();
  } else if (!situation.mute_since) {
    situation.mute_since = now;
  }
  progress_.is_mute = false;
  for (const messages::SafetyEvent& event : progress_.supervisor.watch(mission_, situation))
    static_cast<void>(outputs.safety_events.push_back(event));  // there is room: an event per rule
  situation.is_steered_back = progress_.supervisor.acts_on(config::Condition::kOutsideFence);
  if (progress_.supervisor.response() >= config::Response::kAbort) end(MissionState::kAbort, end_reason_of(*progress_.supervisor.cause()));
}

void Runtime::watch_for_release(Time now, Outputs& outputs) {
  progress_.situation.now = now;
  progress_.situation.snr = progress_.listener.newest()->time;
  outputs.safety_events = progress_.supervisor.watch_for_release(mission_, progress_.situation);
}

messages::Setpoint Runtime::wanted_setpoint() {
  const messages::Navigation& fix = *progress_.situation.navigation.newest();
  const std::optional<config::Response> wanted = response();
  if (progress_.state != MissionState::kSearch)  // whoever ended it
    return progress_.manoeuvre.setpoint(mission_, progress_.situation,
                                        std::max(wanted.value_or(config::Response::kAbort), config::Response::kAbort));
  if (wanted > config::Response::kWarn) return progress_.manoeuvre.setpoint(mission_, progress_.situation, *wanted);
  return {.heading = progress_.leg.heading_to_steer(fix.position),
          .speed = mission_.search_speed,
          .depth = mission_.search_depth,
          .waypoint = progress_.leg.waypoint()};
}

std::optional<messages::Setpoint> Runtime::setpoint(Time now) {
  if (!progress_.command.is_engaged()) return std::nullopt;
  assert(progress_.situation.navigation.newest());  // no search begins without
  const safety::SafeSetpoint safe =
      safety::safe_setpoint(mission_, *progress_.situation.navigation.newest(), wanted_setpoint(), progress_.situation.unseen());
  if (safe.limited) ++progress_.counters.setpoints_limited;
  progress_.situation.depth.tell(now, safe.setpoint, mission_.safety.vehicle);
  progress_.situation.commanded = safe.setpoint;
  progress_.situation.goes_round = safety::goes_round(*progress_.situation.navigation.newest(), safe.setpoint);
  return safe.setpoint;
}

messages::Health Runtime::health(Time now) const {
  return {.turn = progress_.turn,
          .decisions = progress_.decisions,
          .authority = authority::state_of(progress_.command, progress_.state, autopilot_is_connected(now)),
          .is_paused = progress_.command.is_paused(),
          .state = progress_.state,
          .end_reason = progress_.end_reason,
          .steps_taken = progress_.steps_taken,
          .surprise_bits = has_belief() ? memory_.belief().surprise().bits() : 0.0F,
          .is_sweeping = progress_.fallback.is_sweeping(),
          .is_found = found().has_value(),
          .response = progress_.supervisor.response().value_or(config::Response::kWarn),
          .counters = progress_.counters,
          .ports = progress_.ports};
}

}  // namespace earshot::runtime
