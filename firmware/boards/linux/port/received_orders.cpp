#include "firmware/boards/linux/port/received_orders.hpp"

namespace earshot::board {

void ReceivedOrders::judge_mark(messages::OperatorCommand& command, InputSink& sink) const {
  command.is_verified = command.has_old_mark = false;  // whatever its sender says
  if (!proof_) return;
  proof_->judge(command);
  if (command.is_verified || command.order == messages::Order::kAbort) return;
  sink.report_order_trouble(port_, command.has_old_mark ? OrderTrouble::kOldMark : OrderTrouble::kNoMark);
}

std::optional<messages::CommandAcknowledgement> ReceivedOrders::refuse_unreadable(const messages::OperatorCommand& command, Time now,
                                                                                  InputSink& sink) {
  sink.report_order_trouble(port_, OrderTrouble::kUnreadable);
  if (++unreadable_answered_ > config::kMaxAcknowledgements) return std::nullopt;
  return messages::CommandAcknowledgement{.time = now,
                                          .port = port_,
                                          .issuer = command.issuer,
                                          .number = command.number,
                                          .order = command.order,
                                          .outcome = messages::CommandOutcome::kUnreadable};
}

}  // namespace earshot::board
