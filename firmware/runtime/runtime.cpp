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
#include "firmware/runtime/intake.hpp"
#include "firmware/runtime/known_steps.hpp"
#include "firmware/safety/check.hpp"
#include "firmware/safety/limits.hpp"

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

void Runtime::forget() {
  configured_ = false;
  static_assert(std::is_trivially_destructible_v<Progress>);
  std::construct_at(&progress_);  // where it is: another would take most of a microcontroller's stack
  integrity_ = kIntact;
  update_shadow_of_mission();
  update_shadow();
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
  update_shadow_of_mission();
  update_shadow();
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

/// A kind of input that neither this nor Intake knows does not compile.
CommandOutcome Runtime::judge(const messages::Input& input) {
  const auto outcome_of = [this, &input]<class Value>(const Value& value) {
    if constexpr (std::is_same_v<Value, messages::OperatorCommand>) {
      return take_command(input.arrival, input.port, value);
    } else {
      Intake(mission_, progress_).take({.time = input.arrival, .port = input.port}, value);
      return CommandOutcome::kObeyed;
    }
  };
  return std::visit(outcome_of, input.value);
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
  update_shadow_of_mission();
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
  return progress_.snr_window.newest() && now - progress_.snr_window.newest()->time <= mission_.snr_timeout;
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
  situation.snr = progress_.snr_window.newest()->time;
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
  progress_.situation.snr = progress_.snr_window.newest()->time;
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
  progress_.situation.depth.note_order(now, safe.setpoint, mission_.safety.vehicle);
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
          .mismatch_bits = has_belief() ? memory_.belief().model_mismatch().bits() : 0.0F,
          .is_sweeping = progress_.fallback.is_sweeping(),
          .is_found = found().has_value(),
          .response = progress_.supervisor.response().value_or(config::Response::kWarn),
          .counters = progress_.counters,
          .ports = progress_.ports};
}

}  // namespace earshot::runtime
