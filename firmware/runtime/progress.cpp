#include "firmware/runtime/progress.hpp"

#include <algorithm>

namespace earshot::runtime {
namespace {

using messages::CommandOutcome;
using messages::EndReason;
using messages::MissionState;
using messages::Order;

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

void Progress::arm(const config::Mission& mission) {
  random = Pcg32(mission.action_seed);
  orders = Orders(mission.authority.needs_verified_commands);
  intake.configure(mission);
  supervisor_.configure(mission);
  is_armed_ = true;
}

CommandOutcome Progress::obey(const config::Mission& mission, Time arrival, const messages::OperatorCommand& command) {
  if (command.order == Order::kAbort) {
    if (state_ == MissionState::kAbort) return CommandOutcome::kRepeated;
    end(MissionState::kAbort, EndReason::kOperatorAbort);
    return CommandOutcome::kObeyed;
  }
  if (!is_armed_) return CommandOutcome::kNotConfigured;
  if (command.order == Order::kComplete) {
    if (state_ != MissionState::kSearch) return CommandOutcome::kNotInThisState;
    legs.count_step();  // the step under way ends where the source is
    end(MissionState::kDone, EndReason::kCompleted);
    return CommandOutcome::kObeyed;
  }
  const bool was_engaged = command_.is_engaged();
  const CommandOutcome outcome = command_.obey(command, state_, intake.autopilot_is_connected(mission, arrival));
  if (command_.is_engaged() != was_engaged) legs.interrupt();  // what it would have done is not where it is
  return outcome;
}

void Progress::end(MissionState state, EndReason reason) {
  state_ = state;
  end_reason_ = reason;
}

bool Progress::may_begin_search(const config::Mission& mission, Time now) const {
  return state_ == MissionState::kStandby && command_.is_search_ordered(now) && intake.navigation_is_fresh(mission, now) &&
         intake.snr_is_fresh(mission, now) && intake.autopilot_is_connected(mission, now);
}

void Progress::begin_search(Time now) {
  state_ = MissionState::kSearch;
  intake.begin_search(now);
  command_.begin();
}

void Progress::supervise(const config::Mission& mission, Time now, safety::SafetyEvents& events) {
  intake.note_time(now);
  intake.note_mute(now);
  for (const messages::SafetyEvent& event : supervisor_.watch(mission, intake.situation()))
    static_cast<void>(events.push_back(event));  // there is room: an event per rule
  intake.note_steered_back(supervisor_.acts_on(config::Condition::kOutsideFence));
  if (supervisor_.response() >= config::Response::kAbort) end(MissionState::kAbort, end_reason_of(*supervisor_.cause()));
}

void Progress::watch_for_release(const config::Mission& mission, Time now, safety::SafetyEvents& events) {
  intake.note_time(now);
  events = supervisor_.watch_for_release(mission, intake.situation());
}

std::optional<config::Response> Progress::response() const {
  const std::optional<config::Response> of_rules = supervisor_.response();
  return command_.is_paused() ? std::max(of_rules, std::optional(config::Response::kHold)) : of_rules;
}

bool Progress::leg_goes_on(const config::Mission& mission, Time now) const {
  if (!legs.has_begun() || legs.is_interrupted()) return false;
  if (command_.is_engaged()) return !legs.present().is_over(intake.fix().position);
  return !legs.would_be_over(now, mission.search_speed);
}

void Progress::interrupt() {
  legs.interrupt();
  if (response() > config::Response::kSteerBack) intake.forget_waypoint();  // nobody goes there now
}

void Progress::decide_anew() {
  legs.decide_anew();
  manoeuvre_.end();
}

void Progress::begin_leg(const safety::SafeWaypoint& safe, Time now) {
  if (safe.overridden) ++setpoints_limited_;
  legs.begin(guidance::Leg(intake.fix().position, safe.waypoint), now);
  if (command_.is_engaged()) intake.note_waypoint(safe.waypoint);
}

messages::Setpoint Progress::wanted_setpoint(const config::Mission& mission) {
  const std::optional<config::Response> wanted = response();
  if (state_ != MissionState::kSearch)  // whoever ended it
    return manoeuvre_.setpoint(mission, intake.situation(), std::max(wanted.value_or(config::Response::kAbort), config::Response::kAbort));
  if (wanted > config::Response::kWarn) return manoeuvre_.setpoint(mission, intake.situation(), *wanted);
  return {.heading = legs.present().heading_to_steer(intake.fix().position),
          .speed = mission.search_speed,
          .depth = mission.search_depth,
          .waypoint = legs.present().waypoint()};
}

std::optional<messages::Setpoint> Progress::setpoint(const config::Mission& mission, Time now) {
  if (!command_.is_engaged()) return std::nullopt;  // no search begins without a fix
  const safety::SafeSetpoint safe = safety::safe_setpoint(mission, intake.fix(), wanted_setpoint(mission), intake.situation().unseen());
  if (safe.limited) ++setpoints_limited_;
  intake.note_setpoint(now, safe.setpoint, mission.safety.vehicle);
  return safe.setpoint;
}

messages::Health Progress::health(const config::Mission& mission, Time now) const {
  messages::Health health{.turn = turn_,
                          .decisions = legs.decisions(),
                          .authority = authority::state_of(command_, state_, intake.autopilot_is_connected(mission, now)),
                          .is_paused = command_.is_paused(),
                          .state = state_,
                          .end_reason = end_reason_,
                          .steps_taken = legs.steps_taken(),
                          .is_sweeping = fallback.is_sweeping(),
                          .response = supervisor_.response().value_or(config::Response::kWarn),
                          .counters = intake.counters(),
                          .ports = intake.ports()};
  health.counters.commands_refused = orders.refused();
  health.counters.setpoints_limited = setpoints_limited_;
  return health;
}

}  // namespace earshot::runtime
