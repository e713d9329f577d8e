#include "firmware/boards/linux/outage/held_orders.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "firmware/boards/linux/outage/safety_log.hpp"
#include "tests/firmware/runtime/mission_rig.hpp"

namespace earshot::board {
namespace {

using messages::MissionState;
using messages::Order;

constexpr Time kNow{1'795'000'000'000'000};

/// Outputs of a search that commands.
runtime::Outputs searching() {
  runtime::Outputs outputs;
  outputs.health.turn = 100;
  outputs.health.state = MissionState::kSearch;
  outputs.setpoint.emplace();
  return outputs;
}

host::SafetyRecord record_of(const runtime::Outputs& outputs, const config::Mission& mission = runtime::paper_mission()) {
  host::SafetyRecord record;
  record.sequence = 9;
  (void)put_standing(outputs, mission, record);
  return record;
}

std::vector<Order> orders_of(const HeldOrders& held) {
  std::vector<Order> orders;
  for (const messages::OperatorCommand& order : held.orders) orders.push_back(order.order);
  return orders;
}

HeldOrders held(const host::SafetyRecord& record, const runtime::Outputs& last = searching()) {
  return held_orders(record, last, runtime::paper_mission(), kNow);
}

TEST(HeldOrders, AreNoneWhereJournalAndRecordAgree) {
  const HeldOrders none = held(record_of(searching()));
  EXPECT_TRUE(none.orders.empty());
  EXPECT_EQ(none.impossible, "");
}

TEST(HeldOrders, AnAbortThatOnlyTheRecordKnowsIsGivenAnew) {
  for (const MissionState over : {MissionState::kAbort, MissionState::kDone}) {
    runtime::Outputs outputs = searching();
    outputs.health.state = over;
    EXPECT_EQ(orders_of(held(record_of(outputs))), std::vector{Order::kAbort});
    EXPECT_TRUE(held(record_of(outputs), outputs).orders.empty());
    EXPECT_TRUE(held(record_of(searching()), outputs).orders.empty()) << "the journal is the newer";
  }
}

TEST(HeldOrders, PauseAndResumeHoldAsTheNewerOfTheTwoSays) {
  runtime::Outputs paused = searching();
  paused.health.is_paused = true;
  EXPECT_EQ(orders_of(held(record_of(paused))), std::vector{Order::kPause});
  EXPECT_EQ(orders_of(held(record_of(searching()), paused)), std::vector{Order::kResume});
  runtime::Outputs later = searching();
  later.health.turn = 101;
  EXPECT_TRUE(held(record_of(paused), later).orders.empty());
}

TEST(HeldOrders, TightenedLimitsHoldAndNoOthersAreSaid) {
  config::Mission tight = runtime::paper_mission();
  tight.max_depth = Meters{200};
  tight.max_time = Duration::seconds(500);
  const host::SafetyRecord record = record_of(searching(), tight);
  const HeldOrders held = board::held(record);
  ASSERT_EQ(orders_of(held), std::vector{Order::kTighten});
  EXPECT_EQ(held.orders[0].limits.max_depth, Meters{200});
  EXPECT_EQ(held.orders[0].limits.max_speed, std::nullopt);
  EXPECT_EQ(held.orders[0].limits.max_time_s, 500.0);
  EXPECT_FALSE(keeps_limits_of(record, runtime::paper_mission()));
  EXPECT_TRUE(keeps_limits_of(record, tight));
}

TEST(HeldOrders, AreObeyedByARuntimeThatNeedsVerifiedCommandsAndRiseFromOneOutageToTheNext) {
  host::SafetyRecord record = record_of(searching());
  record.state = MissionState::kAbort;
  const messages::OperatorCommand first = held(record).orders[0];
  EXPECT_TRUE(first.is_verified);
  EXPECT_EQ(first.issuer, 0U);
  EXPECT_GT(first.expiry, kNow);
  ++record.sequence;
  EXPECT_GT(held(record).orders[0].number, first.number + 2);
}

TEST(HeldOrders, CannotMakeUpForAStartOrAReleaseThatTheJournalDoesNotKnow) {
  runtime::Outputs before = searching();
  before.setpoint.reset();
  before.health.state = MissionState::kStandby;
  EXPECT_NE(held(record_of(searching()), before).impossible, "");
  runtime::Outputs released = searching();
  released.setpoint->release_weight = true;
  EXPECT_NE(held(record_of(released)).impossible, "");
  EXPECT_EQ(held(record_of(released), released).impossible, "");
}

}  // namespace
}  // namespace earshot::board
