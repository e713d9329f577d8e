#include "firmware/runtime/orders.hpp"

namespace earshot::runtime {
namespace {

using messages::CommandOutcome;
using messages::Order;
using Sender = authority::CommandJudge::Sender;

Sender sender_of(std::uint8_t port) {
  return port == messages::kOwnPort ? Sender::kVehicle : Sender::kOperator;
}

}  // namespace

Orders::Verdict Orders::judge(const Arrival& arrival) {
  return judge_.judge(arrival.time, arrival.command, sender_of(arrival.port));
}

void Orders::answer(const Arrival& arrival, const Verdict& verdict, CommandOutcome outcome) {
  const messages::OperatorCommand& command = arrival.command;
  if (!verdict.is_repetition) {
    if (outcome != CommandOutcome::kObeyed && outcome != CommandOutcome::kRepeated) ++refused_;
    const bool is_to_be_known = command.order != Order::kAbort && sender_of(arrival.port) == Sender::kOperator;
    if (is_to_be_known && verdict.outcome == CommandOutcome::kObeyed) judge_.remember(command, outcome);
  }
  acknowledge({.time = arrival.time,
               .port = arrival.port,
               .issuer = command.issuer,
               .number = command.number,
               .order = command.order,
               .outcome = outcome});
}

/// When there is no room its sender asks again; but an ABORT takes the place of the last.
void Orders::acknowledge(const messages::CommandAcknowledgement& acknowledgement) {
  if (waiting_.push_back(acknowledgement) != Status::kOk && acknowledgement.order == Order::kAbort)
    waiting_[waiting_.size() - 1] = acknowledgement;
}

void Orders::move_acknowledgements_to(Acknowledgements& acknowledgements) {
  acknowledgements = waiting_;
  waiting_.clear();
}

}  // namespace earshot::runtime
