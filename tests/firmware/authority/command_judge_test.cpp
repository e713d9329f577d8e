#include "firmware/authority/command_judge.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <limits>

namespace earshot::authority {
namespace {

using messages::CommandOutcome;
using messages::OperatorCommand;
using messages::Order;

constexpr Time kNow{1'795'000'000'000'000};
constexpr Time kFarAhead{std::numeric_limits<std::int64_t>::max()};

OperatorCommand start(std::uint32_t number, Time time = kNow, std::uint32_t issuer = 7) {
  return {.time = time, .expiry = kFarAhead, .issuer = issuer, .number = number, .order = Order::kStart};
}

/// A judge whose verdicts are acted upon at once.
struct Court {
  CommandJudge judge;
  CommandJudge::Verdict last;

  CommandOutcome hear(const OperatorCommand& command, Time arrival = kNow, CommandOutcome done = CommandOutcome::kObeyed) {
    last = judge.judge(arrival, command);
    if (last.is_repetition || last.outcome != CommandOutcome::kObeyed) return last.outcome;
    judge.remember(command, done);
    return done;
  }
};

TEST(CommandJudge, ObeysTheSameCommandOnceHoweverOftenItIsSent) {
  Court court;
  EXPECT_EQ(court.hear(start(3)), CommandOutcome::kObeyed);
  EXPECT_FALSE(court.last.is_repetition);
  EXPECT_EQ(court.hear(start(3)), CommandOutcome::kObeyed);
  EXPECT_TRUE(court.last.is_repetition);
  EXPECT_EQ(court.hear(start(2)), CommandOutcome::kOutOfOrder);
  EXPECT_EQ(court.hear(start(4)), CommandOutcome::kObeyed);
  EXPECT_FALSE(court.last.is_repetition);
}

TEST(CommandJudge, HearsAnOperatorInWhatIsSaidNowByWhomeverItKnowsToBeOne) {
  Court court;
  const auto is_from_now = [&court](const OperatorCommand& command) {
    (void)court.hear(command);
    return court.last.is_from_now;
  };
  EXPECT_TRUE(is_from_now(start(3)));
  EXPECT_TRUE(is_from_now(start(3))) << "again";
  EXPECT_FALSE(is_from_now(start(2))) << "an old recording";
  EXPECT_FALSE(is_from_now(start(3, kNow + Duration::seconds(-31)))) << "a repetition of half a minute ago";
  EXPECT_FALSE(is_from_now(start(4, kNow + Duration::seconds(-31))));
  EXPECT_FALSE(is_from_now(start(5, kNow + Duration::seconds(-31), 8))) << "of an issuer that it does not know";
  OperatorCommand unknown = start(6);
  unknown.order = static_cast<Order>(99);
  EXPECT_FALSE(is_from_now(unknown));
  court.judge = CommandJudge(true);
  EXPECT_FALSE(is_from_now(start(1)));
  OperatorCommand verified = start(1);
  verified.is_verified = true;
  EXPECT_TRUE(is_from_now(verified));
}

// An operator's program without a number of its own, numbered by its clock.
TEST(CommandJudge, ObeysTheVehiclesOwnOrderWhateverNumberSomebodyUsedAndLeavesHimHis) {
  Court court;
  ASSERT_EQ(court.hear(start(1'795'000'000, kNow, 0)), CommandOutcome::kObeyed);
  const CommandJudge::Verdict own = court.judge.judge(kNow, start(37, kNow, 0), CommandJudge::Sender::kVehicle);
  EXPECT_EQ(own.outcome, CommandOutcome::kObeyed);
  EXPECT_FALSE(own.is_repetition);
  EXPECT_FALSE(own.is_from_now) << "that is no operator";
  EXPECT_EQ(court.hear(start(1'795'000'001, kNow, 0)), CommandOutcome::kObeyed);
  EXPECT_EQ(court.judge.judge(kNow, start(38, kNow + Duration::seconds(-31), 0), CommandJudge::Sender::kVehicle).outcome,
            CommandOutcome::kTooOld);
}

TEST(CommandJudge, AnswersARepeatedCommandAsItDidTheFirstTime) {
  Court court;
  EXPECT_EQ(court.hear(start(3), kNow, CommandOutcome::kNotInThisState), CommandOutcome::kNotInThisState);
  EXPECT_EQ(court.hear(start(3)), CommandOutcome::kNotInThisState);
  EXPECT_TRUE(court.last.is_repetition);
}

TEST(CommandJudge, KnowsOneIssuersNumbersFromAnothers) {
  Court court;
  EXPECT_EQ(court.hear(start(3, kNow, 7)), CommandOutcome::kObeyed);
  EXPECT_EQ(court.hear(start(3, kNow, 8)), CommandOutcome::kObeyed);
  EXPECT_FALSE(court.last.is_repetition);
}

TEST(CommandJudge, RefusesACommandDatedMoreThanHalfAMinuteFromItsArrival) {
  Court court;
  const Duration most = Duration::seconds(30);  // kCommandMaxAge_us
  EXPECT_EQ(court.hear(start(1, kNow + Duration{-most.us - 1})), CommandOutcome::kTooOld);
  EXPECT_EQ(court.hear(start(1, kNow + Duration{most.us + 1})), CommandOutcome::kTooOld);
  EXPECT_EQ(court.hear(start(1, Time{std::numeric_limits<std::int64_t>::min()})), CommandOutcome::kTooOld);
  EXPECT_EQ(court.hear(start(1, kFarAhead)), CommandOutcome::kTooOld);
  EXPECT_EQ(court.hear(start(1, kNow + Duration{-most.us})), CommandOutcome::kObeyed);
}

TEST(CommandJudge, KnowsEveryOrderFromTheFirstToTheLastAndNoOther) {
  Court court;
  for (const Order order : {Order::kStart, Order::kComplete, Order::kListen, Order::kPause, Order::kResume, Order::kTighten}) {
    OperatorCommand command = start(static_cast<std::uint32_t>(order));
    command.order = order;
    EXPECT_EQ(court.hear(command), CommandOutcome::kObeyed) << static_cast<int>(order);
  }
  for (const int number : {0, 8, 255}) {
    OperatorCommand command = start(100);
    command.order = static_cast<Order>(number);
    EXPECT_EQ(court.hear(command), CommandOutcome::kUnknownOrder) << number;
  }
}

TEST(CommandJudge, RefusesWhatIsNotVerifiedWhereTheMissionNamesAKeyButNoAbort) {
  Court court{.judge = CommandJudge(true), .last = {}};
  OperatorCommand command = start(1);
  EXPECT_EQ(court.hear(command), CommandOutcome::kNotVerified);
  command.is_verified = true;
  EXPECT_EQ(court.hear(command), CommandOutcome::kObeyed);
  const OperatorCommand abort{.time = kNow, .expiry = kFarAhead, .issuer = 99, .number = 1, .order = Order::kAbort};
  EXPECT_EQ(court.hear(abort), CommandOutcome::kObeyed);
}

TEST(CommandJudge, RefusesACommandDatedBeforeTheClockBegan) {
  Court court;
  EXPECT_EQ(court.hear(start(1, Time{-1}), Time{1'000'000}), CommandOutcome::kTooOld);
  EXPECT_EQ(court.hear(start(1, Time{0}), Time{1'000'000}), CommandOutcome::kObeyed);
}

TEST(CommandJudge, RefusesACommandAfterItsOwnExpiry) {
  Court court;
  OperatorCommand command = start(1, kNow + Duration::seconds(-10));
  command.expiry = kNow;
  EXPECT_EQ(court.hear(command, kNow + Duration{1}), CommandOutcome::kExpired);
  EXPECT_EQ(court.hear(command, kNow), CommandOutcome::kObeyed) << "the refused one was not counted as given";
}

TEST(CommandJudge, ObeysAnAbortOfAnyDateNumberAndIssuer) {
  Court court;
  EXPECT_EQ(court.hear(start(9, kNow, 99)), CommandOutcome::kObeyed);
  const OperatorCommand abort{.time = Time{0}, .expiry = Time{0}, .issuer = 99, .number = 0, .order = Order::kAbort};
  EXPECT_EQ(court.judge.judge(kNow, abort).outcome, CommandOutcome::kObeyed);
  EXPECT_FALSE(court.judge.judge(kNow, abort).is_repetition);
}

TEST(CommandJudge, ForgetsTheIssuerThatWasSilentForLongestWhenANinthOneComes) {
  Court court;
  for (std::uint32_t issuer = 0; issuer < 8; ++issuer) EXPECT_EQ(court.hear(start(1, kNow, issuer)), CommandOutcome::kObeyed);
  EXPECT_EQ(court.hear(start(2, kNow, 0)), CommandOutcome::kObeyed);  // issuer 1 is the silent one now
  EXPECT_EQ(court.hear(start(1, kNow, 8)), CommandOutcome::kObeyed);
  (void)court.hear(start(2, kNow, 0));
  EXPECT_TRUE(court.last.is_repetition);
  (void)court.hear(start(1, kNow, 1));
  EXPECT_FALSE(court.last.is_repetition) << "forgotten";
}

TEST(CommandJudge, KeepsAnIssuerThatRepeatsItsCommandWhileOthersAreSilent) {
  Court court;
  for (std::uint32_t issuer = 0; issuer < 8; ++issuer) EXPECT_EQ(court.hear(start(1, kNow, issuer)), CommandOutcome::kObeyed);
  (void)court.hear(start(1, kNow, 0));  // not acknowledged yet, as it thinks
  EXPECT_TRUE(court.last.is_repetition);
  (void)court.hear(start(0, kNow, 1));  // out of order, but not silent either
  EXPECT_EQ(court.hear(start(1, kNow, 8)), CommandOutcome::kObeyed);
  for (const std::uint32_t kept : {0U, 1U}) {
    (void)court.hear(start(1, kNow, kept));
    EXPECT_TRUE(court.last.is_repetition) << kept << " would be obeyed twice";
  }
  (void)court.hear(start(1, kNow, 2));
  EXPECT_FALSE(court.last.is_repetition) << "forgotten";
}

TEST(CommandJudge, KeepsAnIssuerHoweverOftenItRepeatsItsCommand) {
  for (int times = 1; times <= 10; ++times) {
    Court court;
    for (std::uint32_t issuer = 0; issuer < 8; ++issuer) EXPECT_EQ(court.hear(start(1, kNow, issuer)), CommandOutcome::kObeyed);
    for (int i = 0; i < times; ++i) (void)court.hear(start(1, kNow, 0));
    (void)court.hear(start(1, kNow, 8));
    (void)court.hear(start(1, kNow, 0));
    EXPECT_TRUE(court.last.is_repetition) << "repeated " << times << " times";
  }
}

TEST(CommandJudge, TakesTheFirstCommandOfAnIssuerForNewThoughItsNumberIsNought) {
  Court court;
  EXPECT_EQ(court.hear(start(0)), CommandOutcome::kObeyed);
  EXPECT_FALSE(court.last.is_repetition);
}

TEST(CommandJudge, GoesOnWhereASendersSignedNumbersTurnNegative) {
  Court court;
  EXPECT_EQ(court.hear(start(2'147'483'647)), CommandOutcome::kObeyed);
  EXPECT_EQ(court.hear(start(2'147'483'648)), CommandOutcome::kObeyed);
  EXPECT_FALSE(court.last.is_repetition);
}

// By hand, as RFC 1982 compares serial numbers of 32 bits.
TEST(CommandJudge, LocksNoIssuerOutByTheHighestNumber) {
  Court court;
  EXPECT_EQ(court.hear(start(4'294'967'295)), CommandOutcome::kObeyed);
  EXPECT_EQ(court.hear(start(0)), CommandOutcome::kObeyed) << "after the last number comes the first";
  EXPECT_FALSE(court.last.is_repetition);
  EXPECT_EQ(court.hear(start(4'294'967'295)), CommandOutcome::kOutOfOrder) << "which is behind it now";
  EXPECT_EQ(court.hear(start(1)), CommandOutcome::kObeyed);
}

TEST(CommandJudge, GoesOnFromAnyNumberWithHalfOfAllNumbers) {
  for (const std::uint32_t last : {0U, 7U, 2'147'483'647U, 2'147'483'648U, 4'294'967'290U}) {
    Court court;
    EXPECT_EQ(court.hear(start(last)), CommandOutcome::kObeyed);
    EXPECT_EQ(court.hear(start(last + 2'147'483'648U)), CommandOutcome::kOutOfOrder) << last << ": as far ahead as behind";
    EXPECT_EQ(court.hear(start(last - 1)), CommandOutcome::kOutOfOrder) << last;
    EXPECT_EQ(court.hear(start(last + 2'147'483'647U)), CommandOutcome::kObeyed) << last;
  }
}

TEST(CommandJudge, SaysOfAMarkThatLacksTheChallengeThatItIsOld) {
  Court court{.judge = CommandJudge(true), .last = {}};
  OperatorCommand command = start(1);
  command.has_old_mark = true;
  EXPECT_EQ(court.hear(command), CommandOutcome::kOldMark);
  EXPECT_FALSE(court.last.is_from_now);
  command.is_verified = true;
  EXPECT_EQ(court.hear(command), CommandOutcome::kObeyed);
}

TEST(CommandJudge, AnswersACommandThatCameAfterNewerOnesAsOutOfOrderAndTheNewestAsBefore) {
  Court court;
  EXPECT_EQ(court.hear(start(7)), CommandOutcome::kObeyed);
  EXPECT_EQ(court.hear(start(6)), CommandOutcome::kOutOfOrder);
  EXPECT_FALSE(court.last.is_repetition);
  EXPECT_EQ(court.hear(start(7), kNow, CommandOutcome::kNotInThisState), CommandOutcome::kObeyed) << "obeyed then";
  EXPECT_TRUE(court.last.is_repetition);
}

TEST(CommandJudge, JudgesTheDateOfANewCommandOfAnIssuerThatItKnows) {
  Court court;
  EXPECT_EQ(court.hear(start(1)), CommandOutcome::kObeyed);
  EXPECT_EQ(court.hear(start(2, kNow + Duration::seconds(-31))), CommandOutcome::kTooOld);
  EXPECT_EQ(court.hear(start(2)), CommandOutcome::kObeyed) << "the refused one was not counted as given";
  EXPECT_FALSE(court.last.is_repetition);
}

TEST(CommandJudge, RefusesAnUnknownOrder) {
  Court court;
  OperatorCommand strange = start(2);
  strange.order = static_cast<Order>(9);
  EXPECT_EQ(court.hear(strange), CommandOutcome::kUnknownOrder);
}

}  // namespace
}  // namespace earshot::authority
