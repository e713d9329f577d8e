#include "firmware/runtime/command_judge.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <limits>

namespace earshot::runtime {
namespace {

using messages::CommandOutcome;
using messages::OperatorCommand;
using messages::Order;

constexpr Time kNow{1'795'000'000'000'000};
constexpr Time kFarAhead{std::numeric_limits<std::int64_t>::max()};

OperatorCommand start(std::uint32_t number, Time time = kNow, std::uint32_t issuer = 7) {
  return {.time = time, .expiry = kFarAhead, .issuer = issuer, .number = number, .order = Order::kStart};
}

TEST(CommandJudge, ObeysTheSameCommandOnceHoweverOftenItIsSent) {
  CommandJudge judge;
  EXPECT_EQ(judge.judge(kNow, start(3)), CommandOutcome::kObeyed);
  EXPECT_EQ(judge.judge(kNow, start(3)), CommandOutcome::kRepeated);
  EXPECT_EQ(judge.judge(kNow, start(2)), CommandOutcome::kOutOfOrder);
  EXPECT_EQ(judge.judge(kNow, start(4)), CommandOutcome::kObeyed);
}

TEST(CommandJudge, KnowsOneIssuersNumbersFromAnothers) {
  CommandJudge judge;
  EXPECT_EQ(judge.judge(kNow, start(3, kNow, 7)), CommandOutcome::kObeyed);
  EXPECT_EQ(judge.judge(kNow, start(3, kNow, 8)), CommandOutcome::kObeyed);
}

TEST(CommandJudge, RefusesACommandDatedMoreThanHalfAMinuteFromItsArrival) {
  CommandJudge judge;
  const Duration most = Duration::seconds(30);  // kCommandMaxAge_us
  EXPECT_EQ(judge.judge(kNow, start(1, kNow + Duration{-most.us - 1})), CommandOutcome::kTooOld);
  EXPECT_EQ(judge.judge(kNow, start(1, kNow + Duration{most.us + 1})), CommandOutcome::kTooOld);
  EXPECT_EQ(judge.judge(kNow, start(1, Time{std::numeric_limits<std::int64_t>::min()})), CommandOutcome::kTooOld);
  EXPECT_EQ(judge.judge(kNow, start(1, kFarAhead)), CommandOutcome::kTooOld);
  EXPECT_EQ(judge.judge(kNow, start(1, kNow + Duration{-most.us})), CommandOutcome::kObeyed);
}

TEST(CommandJudge, RefusesACommandAfterItsOwnExpiry) {
  CommandJudge judge;
  OperatorCommand command = start(1, kNow + Duration::seconds(-10));
  command.expiry = kNow;
  EXPECT_EQ(judge.judge(kNow + Duration{1}, command), CommandOutcome::kExpired);
  EXPECT_EQ(judge.judge(kNow, command), CommandOutcome::kObeyed) << "the refused one was not counted as given";
}

TEST(CommandJudge, ObeysAnAbortOfAnyDateNumberAndIssuer) {
  CommandJudge judge;
  for (std::uint32_t issuer = 0; issuer < 20; ++issuer) (void)judge.judge(kNow, start(1, kNow, issuer));
  const OperatorCommand abort{.time = Time{0}, .expiry = Time{0}, .issuer = 99, .number = 0, .order = Order::kAbort};
  EXPECT_EQ(judge.judge(kNow, abort), CommandOutcome::kObeyed);
}

TEST(CommandJudge, RefusesANinthIssuerAndAnUnknownOrder) {
  CommandJudge judge;
  for (std::uint32_t issuer = 0; issuer < 8; ++issuer) EXPECT_EQ(judge.judge(kNow, start(1, kNow, issuer)), CommandOutcome::kObeyed);
  EXPECT_EQ(judge.judge(kNow, start(1, kNow, 8)), CommandOutcome::kTooManyIssuers);
  OperatorCommand strange = start(2, kNow, 0);
  strange.order = static_cast<Order>(9);
  EXPECT_EQ(judge.judge(kNow, strange), CommandOutcome::kUnknownOrder);
}

}  // namespace
}  // namespace earshot::runtime
