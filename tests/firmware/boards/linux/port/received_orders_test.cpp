#include "firmware/boards/linux/port/received_orders.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace earshot::board {
namespace {

constexpr std::uint8_t kPort = 3;

class TakenTroubles final : public InputSink {
 public:
  void take(std::uint8_t /*port*/, const Value& /*value*/) override {}
  void report_order_trouble(std::uint8_t port, OrderTrouble trouble) override {
    EXPECT_EQ(port, kPort);
    troubles.push_back(trouble);
  }
  std::vector<OrderTrouble> troubles;
};

constexpr messages::OperatorCommand kStart{.time = {}, .expiry = {}, .issuer = 4711, .number = 12, .order = messages::Order::kStart};

TEST(ReceivedOrders, TrustNoSenderWhoSaysThatHisMarkIsRightWhereThereIsNoKey) {
  const ReceivedOrders orders(kPort, std::nullopt);
  TakenTroubles sink;
  messages::OperatorCommand command = kStart;
  command.is_verified = command.has_old_mark = true;
  orders.judge_mark(command, sink);
  EXPECT_FALSE(command.is_verified);
  EXPECT_FALSE(command.has_old_mark);
  EXPECT_TRUE(sink.troubles.empty()) << "nobody asked for a mark";
}

TEST(ReceivedOrders, ReportAMissingMarkButNotOfAnAbort) {
  const ReceivedOrders orders(kPort,
                              host::CommandProof{.key = host::CommandKey(host::KeyBytes{7}), .challenge = host::new_challenge("a", {})});
  TakenTroubles sink;
  messages::OperatorCommand command = kStart;
  orders.judge_mark(command, sink);
  EXPECT_EQ(sink.troubles, std::vector{OrderTrouble::kNoMark});
  command.order = messages::Order::kAbort;
  orders.judge_mark(command, sink);
  EXPECT_EQ(sink.troubles.size(), 1U) << "an ABORT is obeyed whatever its mark";
}

TEST(ReceivedOrders, AnswerWhatCannotBeReadUpToTheOrdersOfATurn) {
  ReceivedOrders orders(kPort, std::nullopt);
  TakenTroubles sink;
  for (std::size_t i = 0; i < config::kMaxAcknowledgements; ++i) {
    const auto answer = orders.refuse_unreadable(kStart, Time{5}, sink);
    ASSERT_TRUE(answer);
    EXPECT_EQ(answer->time, Time{5});
    EXPECT_EQ(answer->port, kPort);
    EXPECT_EQ(answer->issuer, 4711U);
    EXPECT_EQ(answer->number, 12U);
    EXPECT_EQ(answer->order, messages::Order::kStart);
    EXPECT_EQ(answer->outcome, messages::CommandOutcome::kUnreadable);
  }
  EXPECT_FALSE(orders.refuse_unreadable(kStart, Time{5}, sink));
  EXPECT_EQ(sink.troubles.size(), config::kMaxAcknowledgements + 1) << "a person hears of each";
  orders.end_turn();
  EXPECT_TRUE(orders.refuse_unreadable(kStart, Time{6}, sink));
}

}  // namespace
}  // namespace earshot::board
