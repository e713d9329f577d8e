#include "firmware/boards/linux/core/order_gate.hpp"

#include <gtest/gtest.h>

namespace earshot::board {
namespace {

using messages::OperatorCommand;
using messages::Order;

constexpr Time kNow{1'795'000'000'000'000};

OperatorCommand order(Order what, bool is_verified = false) {
  OperatorCommand command;
  command.order = what;
  command.is_verified = is_verified;
  return command;
}

int passed(OrderGate& gate, const OperatorCommand& given, int count, Time now = kNow, bool is_aborted = false) {
  int through = 0;
  for (int i = 0; i < count; ++i) through += gate.lets_through(given, now, is_aborted) ? 1 : 0;
  return through;
}

TEST(OrderGate, LetsThirtyTwoThroughAtOnceAndThenTwentyASecond) {
  OrderGate gate;
  const OperatorCommand pause = order(Order::kPause);
  EXPECT_EQ(passed(gate, pause, 1000), 32);
  EXPECT_EQ(passed(gate, pause, 1000, kNow + Duration::seconds(1)), 20);
  EXPECT_EQ(passed(gate, pause, 1000, kNow + Duration::seconds(100)), 32);
}

TEST(OrderGate, StrangersDoNotUseUpTheShareOfThoseWhoKnowTheKey) {
  OrderGate gate;
  EXPECT_EQ(passed(gate, order(Order::kPause), 1000), 32);
  EXPECT_EQ(passed(gate, order(Order::kPause, true), 1000), 32);
}

TEST(OrderGate, LetsEveryAbortThroughUntilOneHasEndedTheMission) {
  OrderGate gate;
  EXPECT_EQ(passed(gate, order(Order::kStart), 1000), 32);
  EXPECT_EQ(passed(gate, order(Order::kAbort), 1000), 1000);
  EXPECT_EQ(passed(gate, order(Order::kAbort), 1000, kNow + Duration::seconds(1), true), 20);
}

}  // namespace
}  // namespace earshot::board
