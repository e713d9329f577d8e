#include "firmware/runtime/runtime.hpp"

#include <cassert>
#include <memory>
#include <type_traits>
#include <variant>

#include "firmware/authority/tightened.hpp"
#include "firmware/runtime/search.hpp"
#include "firmware/safety/check.hpp"

namespace earshot::runtime {
namespace {

using messages::CommandOutcome;
using messages::MissionState;

Status status_of(const config::Mission& mission) {
  if (const Status status = config::check(mission); status != Status::kOk) return status;
  return safety::check(mission).is_none() ? Status::kOk : Status::kOutOfRange;
}

}  // namespace

void Runtime::forget() {
  static_assert(std::is_trivially_destructible_v<Progress>);
  std::construct_at(&progress_);  // where it is: another would take most of a microcontroller's stack
  shadow_.trust(mission_, progress_);
}

void Runtime::arm(const config::Mission& mission) {
  mission_ = mission;
  progress_.arm(mission_);
  shadow_.trust(mission_, progress_);
}

Status Runtime::configure(const config::Mission& mission, const policy::FrozenPolicy& policy, const policy::OceanTables& tables) {
  forget();
  if (const Status status = status_of(mission); status != Status::kOk) return status;
  if (const Status status = agent_.load(mission, policy, tables); status != Status::kOk) return status;
  arm(mission);
  return Status::kOk;
}

Status Runtime::configure(const config::Mission& mission, std::span<const std::uint8_t> policy, std::span<const std::uint8_t> tables) {
  forget();
  if (const Status status = status_of(mission); status != Status::kOk) return status;
  if (const Status status = agent_.load(mission, policy, tables); status != Status::kOk) return status;
  arm(mission);
  return Status::kOk;
}

CommandOutcome Runtime::take(const messages::Input& input) {
  assert(input.port < config::kMaxPorts);
  shadow_.compare(progress_);
  if (!shadow_.is_trusted()) return CommandOutcome::kNotInThisState;
  const CommandOutcome outcome = judge(input);
  shadow_.copy(progress_);
  return outcome;
}

/// A kind of input that neither this nor Intake knows does not compile.
CommandOutcome Runtime::judge(const messages::Input& input) {
  const auto outcome_of = [this, &input]<class Value>(const Value& value) {
    if constexpr (std::is_same_v<Value, messages::OperatorCommand>) {
      return take_order({.time = input.arrival, .port = input.port, .command = value});
    } else {
      progress_.intake.take({.mission = mission_, .state = progress_.state(), .time = input.arrival, .port = input.port}, value);
      return CommandOutcome::kObeyed;
    }
  };
  return std::visit(outcome_of, input.value);
}

CommandOutcome Runtime::take_order(const Orders::Arrival& arrival) {
  const Orders::Verdict verdict = progress_.orders.judge(arrival);
  if (verdict.is_from_now) progress_.intake.note_operator(arrival.time);
  CommandOutcome outcome = verdict.outcome;
  if (outcome == CommandOutcome::kObeyed && !verdict.is_repetition) {
    const bool is_for_limits = arrival.command.order == messages::Order::kTighten;
    outcome = is_for_limits ? tighten(arrival.command.limits) : progress_.obey(mission_, arrival.time, arrival.command);
  }
  progress_.orders.answer(arrival, verdict, outcome);
  return outcome;
}

CommandOutcome Runtime::tighten(const messages::OperatorLimits& limits) {
  if (!progress_.is_armed()) return CommandOutcome::kNotConfigured;
  if (progress_.state() != MissionState::kStandby && progress_.state() != MissionState::kSearch) return CommandOutcome::kNotInThisState;
  shadow_.compare(mission_);  // what is copied now is believed from now on
  if (!shadow_.is_trusted()) return CommandOutcome::kNotInThisState;
  if (authority::tighten(mission_, limits) != Status::kOk) return CommandOutcome::kNotTighter;
  shadow_.copy(mission_);
  progress_.tighten(mission_);
  return CommandOutcome::kObeyed;
}

Outputs Runtime::step(Time now) {
  assert(now.us >= 0);
  shadow_.compare(progress_);
  shadow_.compare(mission_);
  Outputs outputs;
  if (shadow_.is_trusted()) turn(now, outputs);
  if (shadow_.is_trusted()) {
    shadow_.copy(progress_);
  } else {
    shadow_.bring_up(now, mission_, progress_, outputs);
  }
  return outputs;  // one object: what is returned in two places lies on the stack twice
}

void Runtime::turn(Time now, Outputs& outputs) {
  progress_.begin_turn();
  Search search(mission_, agent_, progress_);
  if (progress_.may_begin_search(mission_, now) && search.begin(now) != Status::kOk) return shadow_.distrust();
  if (progress_.state() == MissionState::kSearch) {
    if (search.turn(now, outputs) != Status::kOk) shadow_.distrust();
  } else if (progress_.is_engaged()) {
    progress_.watch_for_release(mission_, now, outputs.safety_events);
  }
  outputs.setpoint = progress_.setpoint(mission_, now);
  progress_.orders.move_acknowledgements_to(outputs.acknowledgements);
  outputs.health = progress_.health(mission_, now);
  outputs.health.mismatch_bits = agent_.mismatch_bits();
  outputs.health.is_found = agent_.has_found();
}

}  // namespace earshot::runtime
