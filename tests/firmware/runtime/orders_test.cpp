#include "firmware/runtime/orders.hpp"

#include <gtest/gtest.h>

#include <cstdint>

namespace earshot::runtime {
namespace {

using messages::CommandOutcome;
using messages::Order;

constexpr Time kGiven{1'795'000'000'000'000};
constexpr std::uint8_t kStation = 3;

messages::OperatorCommand numbered(Order order, std::uint32_t number) {
  return {.time = kGiven, .expiry = kGiven + Duration::seconds(60), .issuer = 7, .number = number, .order = order};
}

/// Orders of which every one that is to be obeyed has one outcome.
struct Desk {
  Orders orders;

  Orders::Verdict take(const messages::OperatorCommand& command, CommandOutcome done, std::uint8_t port = kStation) {
    const Orders::Arrival arrival{.time = kGiven, .port = port, .command = command};
    const Orders::Verdict verdict = orders.judge(arrival);
    const bool is_to_be_obeyed = verdict.outcome == CommandOutcome::kObeyed && !verdict.is_repetition;
    orders.answer(arrival, verdict, is_to_be_obeyed ? done : verdict.outcome);
    return verdict;
  }

  Acknowledgements acknowledgements() {
    Acknowledgements moved;
    orders.move_acknowledgements_to(moved);
    return moved;
  }
};

TEST(Orders, AcknowledgeWhatBecameOfACommandToThePortItCameByAndOnce) {
  Desk desk;
  desk.take(numbered(Order::kPause, 5), CommandOutcome::kNotInThisState);
  const Acknowledgements first = desk.acknowledgements();
  ASSERT_EQ(first.size(), 1U);
  EXPECT_EQ(
      first[0],
      (messages::CommandAcknowledgement{
          .time = kGiven, .port = kStation, .issuer = 7, .number = 5, .order = Order::kPause, .outcome = CommandOutcome::kNotInThisState}));
  EXPECT_EQ(desk.acknowledgements().size(), 0U);
}

TEST(Orders, CountWhatWasRefusedButNothingThatWasDoneBefore) {
  Desk desk;
  desk.take(numbered(Order::kStart, 1), CommandOutcome::kObeyed);
  desk.take(numbered(Order::kPause, 2), CommandOutcome::kRepeated);
  EXPECT_EQ(desk.orders.refused(), 0U);
  desk.take(numbered(Order::kStart, 3), CommandOutcome::kNotInThisState);
  EXPECT_EQ(desk.orders.refused(), 1U);
}

TEST(Orders, AnswerARepetitionAsBeforeAndCountItNoSecondTime) {
  Desk desk;
  desk.take(numbered(Order::kStart, 1), CommandOutcome::kNotInThisState);
  const Orders::Verdict again = desk.take(numbered(Order::kStart, 1), CommandOutcome::kObeyed);
  EXPECT_TRUE(again.is_repetition);
  EXPECT_EQ(again.outcome, CommandOutcome::kNotInThisState);
  EXPECT_EQ(desk.orders.refused(), 1U);
  EXPECT_EQ(desk.acknowledgements().size(), 2U);
}

TEST(Orders, RememberNoAbortAndNothingThatTheVehicleTellsItself) {
  Desk desk;
  desk.take(numbered(Order::kAbort, 9), CommandOutcome::kObeyed);
  desk.take(numbered(Order::kPause, 8), CommandOutcome::kObeyed, messages::kOwnPort);
  const Orders::Verdict verdict = desk.take(numbered(Order::kStart, 1), CommandOutcome::kObeyed);
  EXPECT_EQ(verdict.outcome, CommandOutcome::kObeyed) << "no number of this issuer is known";
  EXPECT_FALSE(verdict.is_repetition);
}

TEST(Orders, LeaveOutTheLastAcknowledgementsForWhichThereIsNoRoomButNoAborts) {
  Desk desk;
  for (std::uint32_t number = 1; number <= config::kMaxAcknowledgements + 1; ++number)
    desk.take(numbered(Order::kPause, number), CommandOutcome::kObeyed);
  desk.take(numbered(Order::kAbort, 99), CommandOutcome::kObeyed);
  const Acknowledgements waiting = desk.acknowledgements();
  ASSERT_EQ(waiting.size(), config::kMaxAcknowledgements);
  EXPECT_EQ(waiting[0].number, 1U);
  EXPECT_EQ(waiting[waiting.size() - 2].number, config::kMaxAcknowledgements - 1);
  EXPECT_EQ(waiting[waiting.size() - 1].order, Order::kAbort);
}

TEST(Orders, AreToBeVerifiedWhereTheMissionNamesAKey) {
  Desk desk{.orders = Orders(true)};
  EXPECT_EQ(desk.take(numbered(Order::kStart, 1), CommandOutcome::kObeyed).outcome, CommandOutcome::kNotVerified);
}

}  // namespace
}  // namespace earshot::runtime
