#include "firmware/wire/n2k/node/address_claim.hpp"

#include <gtest/gtest.h>

namespace earshot::n2k {
namespace {

constexpr Time kBegin{1'000'000};
constexpr Name kName = 0xC050'9635'E772'EE1F;  // tests/reference/n2k/frames.txt, source 204
// C0 ^ 50 = 90, ^ 96 = 06, ^ 35 = 33, ^ E7 = D4, ^ 72 = A6, ^ EE = 48, ^ 1F = 57: 87 times 0.6 ms.
constexpr Duration kDelay{52'200};

/// One that holds an address and then hears that all are taken by devices with more rights.
AddressClaim driven_out(Time now) {
  AddressClaim claim(kName, 0x40);
  EXPECT_TRUE(claim.claim_due(now + Duration{-2 * kClaimTime.us}));
  EXPECT_FALSE(claim.claim_due(now + Duration{-kClaimTime.us}));
  EXPECT_EQ(claim.address(), 0x40);
  for (unsigned address = 0; address <= kLastAddress; ++address) claim.accept(static_cast<std::uint8_t>(address), 1 + address, now);
  EXPECT_FALSE(claim.address());
  return claim;
}

TEST(AddressClaim, WaitsBeforeItSaysThatItHasNone) {
  AddressClaim claim = driven_out(kBegin);
  EXPECT_FALSE(claim.claim_due(kBegin));
  EXPECT_FALSE(claim.claim_due(kBegin + kDelay + Duration{-1}));
  EXPECT_TRUE(claim.claim_due(kBegin + kDelay));
  EXPECT_EQ(claim.source(), kNullAddress);
  EXPECT_FALSE(claim.claim_due(kBegin + Duration::seconds(1))) << "told once";
}

TEST(AddressClaim, WaitsAsLongWhenSomebodyAsksAndNotLongerWhenHeAsksAgain) {
  AddressClaim claim = driven_out(kBegin);
  EXPECT_TRUE(claim.claim_due(kBegin + kDelay));
  const Time asked = kBegin + Duration::seconds(1);
  claim.ask(asked);
  EXPECT_FALSE(claim.claim_due(asked));
  claim.ask(asked + Duration{kDelay.us - 1});
  EXPECT_FALSE(claim.claim_due(asked + Duration{kDelay.us - 1}));
  EXPECT_TRUE(claim.claim_due(asked + kDelay));
}

TEST(AddressClaim, AnswersAtOnceWhileItHasAnAddress) {
  AddressClaim claim(kName, 0x40);
  EXPECT_TRUE(claim.claim_due(kBegin));
  EXPECT_FALSE(claim.claim_due(kBegin + kClaimTime));
  claim.ask(kBegin + kClaimTime);
  EXPECT_TRUE(claim.claim_due(kBegin + kClaimTime));
}

TEST(AddressClaim, WaitsFromNothingTo153MillisecondsBeforeItSaysThatItHasNone) {
  EXPECT_EQ(cannot_claim_delay(0), Duration{});
  EXPECT_EQ(cannot_claim_delay(0xC0'50'96'35'E7'72'EE'1F ^ 0x57 ^ 0xFF), Duration::milliseconds(153));
  for (Name last = 1; last < 256; ++last) {
    EXPECT_GE(cannot_claim_delay(kName ^ last), Duration{});
    EXPECT_LE(cannot_claim_delay(kName ^ last), kLongestCannotClaimDelay);
    EXPECT_NE(cannot_claim_delay(kName ^ last), cannot_claim_delay(kName)) << "of the same maker";
  }
}

TEST(AddressClaim, ClaimsAgainAtOnceWhenItIsMovedAndNotWhenItIsThereAlready) {
  AddressClaim claim(kName, 0x40);
  EXPECT_TRUE(claim.claim_due(kBegin));
  EXPECT_EQ(claim.move_to(0x40), Status::kOk);
  EXPECT_FALSE(claim.claim_due(kBegin + kClaimTime));
  EXPECT_EQ(claim.address(), 0x40);
  EXPECT_EQ(claim.move_to(251), Status::kOk);
  EXPECT_FALSE(claim.address());
  EXPECT_TRUE(claim.claim_due(kBegin + kClaimTime));
  EXPECT_EQ(claim.source(), 251);
  EXPECT_EQ(claim.move_to(252), Status::kOutOfRange);
  EXPECT_EQ(claim.source(), 251);
}

TEST(AddressClaim, MovesToAnAddressAlsoWhenItHasNone) {
  AddressClaim claim = driven_out(kBegin);
  EXPECT_EQ(claim.move_to(0x40), Status::kOk);
  EXPECT_TRUE(claim.claim_due(kBegin));
  EXPECT_EQ(claim.source(), 0x40);
}

TEST(AddressClaim, HoldsAnAddressAQuarterOfASecondAfterItsFirstClaimOfIt) {
  AddressClaim claim(kName, 0x40);
  EXPECT_TRUE(claim.claim_due(kBegin));
  claim.accept(0x40, kName + 1, kBegin);  // somebody with fewer rights: it claims again, and goes on waiting
  EXPECT_FALSE(claim.claim_due(kBegin + kLeastClaimGap + Duration{-1}));
  EXPECT_TRUE(claim.claim_due(kBegin + kLeastClaimGap));
  EXPECT_FALSE(claim.claim_due(kBegin + kClaimTime + Duration{-1}));
  EXPECT_FALSE(claim.address());
  EXPECT_FALSE(claim.claim_due(kBegin + kClaimTime));
  EXPECT_EQ(claim.address(), 0x40);
}

TEST(AddressClaim, TriesAgainHalfAMinuteAfterItWasDrivenOut) {
  AddressClaim claim = driven_out(kBegin);
  EXPECT_TRUE(claim.claim_due(kBegin + kDelay));
  EXPECT_FALSE(claim.claim_due(kBegin + kClaimAgain + Duration{-1}));
  EXPECT_EQ(claim.source(), kNullAddress);
  EXPECT_TRUE(claim.claim_due(kBegin + kClaimAgain));
  EXPECT_EQ(claim.source(), 0x40) << "the one it prefers";
}

TEST(AddressClaim, IgnoresClaimsOfAddressesThatNobodyMayHave) {
  AddressClaim claim(kName, 251);
  EXPECT_TRUE(claim.claim_due(kBegin));
  for (const std::uint8_t source : {std::uint8_t{252}, std::uint8_t{254}}) claim.accept(source, 1, kBegin);
  EXPECT_FALSE(claim.claim_due(kBegin + kClaimTime));
  claim.accept(251, 1, kBegin + kClaimTime);
  EXPECT_TRUE(claim.claim_due(kBegin + kClaimTime));
  EXPECT_EQ(claim.source(), 0) << "after the last comes the first";
}

/// Somebody with all rights claims each address as soon as it is claimed, for five minutes of steps of 20 ms.
/// @return the longest time for which it could send from none, looked at after its step, as a set-point is sent
Duration longest_mute(AddressClaim& claim, Duration answer) {
  bool is_to_be_taken = false;
  Time to_take;
  Time could_send = kBegin;
  Duration longest;
  for (Time now = kBegin; now < kBegin + Duration::seconds(300); now = now + kLeastClaimGap) {
    if (is_to_be_taken && now >= to_take) {
      claim.accept(claim.source(), 1, now);
      is_to_be_taken = false;
    }
    if (claim.claim_due(now) && claim.source() != kNullAddress) {
      is_to_be_taken = true;
      to_take = now + answer;
    }
    if (claim.address()) could_send = now;
    longest = std::max(longest, now - could_send);
  }
  return longest;
}

// 381 claims muted a vehicle for 75 s: an address a quarter of a second, and then none for half a minute.
TEST(AddressClaim, IsNotMuteForLongHoweverManyAddressesAreTakenFromIt) {
  for (const std::int64_t answer_ms : {1, 20, 100, 240}) {
    AddressClaim claim(kName, 0x40);
    EXPECT_LE(longest_mute(claim, Duration::milliseconds(answer_ms)), Duration::milliseconds(1100)) << answer_ms;
    EXPECT_GT(claim.counters().lost, 1000U) << answer_ms;
  }
}

TEST(AddressClaim, WaitsForSilenceAgainOnceTheWarIsOver) {
  AddressClaim claim(kName, 0x40);
  for (int i = 0; i < 3; ++i) {
    EXPECT_TRUE(claim.claim_due(kBegin + Duration::milliseconds(100 * i)));
    EXPECT_FALSE(claim.address()) << i;
    claim.accept(claim.source(), 1, kBegin + Duration::milliseconds(100 * i));
  }
  EXPECT_TRUE(claim.claim_due(kBegin + Duration::milliseconds(300)));
  EXPECT_EQ(claim.address(), 0x43);
  const Time later = kBegin + Duration::milliseconds(200) + kWarMemory + Duration{1};
  claim.accept(0x43, 1, later);
  EXPECT_TRUE(claim.claim_due(later));
  EXPECT_FALSE(claim.address()) << "one address is no war";
}

}  // namespace
}  // namespace earshot::n2k
