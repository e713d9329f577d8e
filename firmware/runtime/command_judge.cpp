#include "firmware/runtime/command_judge.hpp"

#include <algorithm>

namespace earshot::runtime {
namespace {

using messages::CommandOutcome;
using messages::Order;

constexpr Duration kMaxAge{config::kCommandMaxAge_us};

bool is_known(Order order) {
  return order == Order::kStart || order == Order::kComplete || order == Order::kAbort;
}

CommandOutcome judge_date(Time arrival, const messages::OperatorCommand& command) {
  if (!lies_within(command.time, arrival, kMaxAge)) return CommandOutcome::kTooOld;
  return arrival > command.expiry ? CommandOutcome::kExpired : CommandOutcome::kObeyed;
}

}  // namespace

CommandOutcome CommandJudge::judge(Time arrival, const messages::OperatorCommand& command) {
  if (!is_known(command.order)) return CommandOutcome::kUnknownOrder;
  if (command.order == Order::kAbort) return CommandOutcome::kObeyed;
  if (const CommandOutcome outcome = judge_date(arrival, command); outcome != CommandOutcome::kObeyed) return outcome;
  const auto known = std::find_if(issuers_.begin(), issuers_.end(), [&](const Issuer& i) { return i.issuer == command.issuer; });
  if (known == issuers_.end()) {
    const Status kept = issuers_.push_back({.issuer = command.issuer, .last_number = command.number});
    return kept == Status::kOk ? CommandOutcome::kObeyed : CommandOutcome::kTooManyIssuers;
  }
  if (command.number <= known->last_number)
    return command.number == known->last_number ? CommandOutcome::kRepeated : CommandOutcome::kOutOfOrder;
  known->last_number = command.number;
  return CommandOutcome::kObeyed;
}

}  // namespace earshot::runtime
