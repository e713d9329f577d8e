#include "policy/explain/replay.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <memory>

#include "tests/policy/explain/flown_policy.hpp"

namespace earshot::explain {
namespace {

constexpr NorthEast kSouthWest{Meters{-3'000.0}, Meters{750.0}};

Contradiction last_contradiction(const policy::FrozenPolicy& policy, std::span<const RecordedDecision> taken, NorthEast south_west) {
  return contradiction(policy, taken.back(), *remembered_at(policy.observation, falling_ocean(), taken, south_west));
}

TEST(Replay, MakesEveryRecordedObservationAgainBitForBit) {
  const auto policy = belief_policy(1);
  const std::vector<RecordedDecision> taken = flown(*policy, 6, kSouthWest);
  for (std::size_t i = 1; i <= taken.size(); ++i)
    EXPECT_EQ(last_contradiction(*policy, std::span(taken).first(i), kSouthWest), Contradiction::kNone) << i;
}

TEST(Replay, KnowsThatAnotherPolicyTookTheDecision) {
  const std::vector<RecordedDecision> taken = flown(*belief_policy(1), 3, kSouthWest);
  EXPECT_EQ(last_contradiction(*belief_policy(2), taken, kSouthWest), Contradiction::kLogits);
  EXPECT_EQ(last_contradiction(*place_policy(1), taken, kSouthWest), Contradiction::kSizes);
}

TEST(Replay, KnowsThatThePastIsNotTheOneThatWasSeen) {
  const auto policy = belief_policy(1);
  std::vector<RecordedDecision> taken = flown(*policy, 4, kSouthWest);
  EXPECT_EQ(last_contradiction(*policy, taken, {}), Contradiction::kObservation) << "of another corner";
  taken[1].snr = taken[1].snr + Decibels{1.0};
  EXPECT_EQ(last_contradiction(*policy, taken, kSouthWest), Contradiction::kObservation) << "of another look";
}

TEST(Replay, MakesTheDecisionsOfAPolicyWithoutANetworkAgainBitForBit) {
  const auto policy = advice_policy();
  std::vector<RecordedDecision> taken = flown(*policy, 4, kSouthWest);
  EXPECT_EQ(last_contradiction(*policy, taken, kSouthWest), Contradiction::kNone);
  taken.back().logits[2] += 0.5F;
  EXPECT_EQ(last_contradiction(*policy, taken, kSouthWest), Contradiction::kLogits);
}

TEST(Replay, KnowsThatItSearchedByOtherTables) {
  const auto policy = belief_policy(1);
  const std::vector<RecordedDecision> taken = flown(*policy, 4, kSouthWest);
  auto louder = std::make_unique<policy::OceanTables>(falling_ocean());
  for (std::int8_t& half_db : louder->tables[0].snr_half_db) half_db = static_cast<std::int8_t>(half_db + 2);
  EXPECT_EQ(contradiction(*policy, taken.back(), *remembered_at(policy->observation, *louder, taken, kSouthWest)),
            Contradiction::kObservation);
}

TEST(Replay, RefusesAnActionThatThePolicyHasNot) {
  const auto policy = place_policy(1);
  std::vector<RecordedDecision> taken = flown(*policy, 1, kSouthWest);
  taken[0].action = 8;
  EXPECT_EQ(last_contradiction(*policy, taken, kSouthWest), Contradiction::kSizes);
}

TEST(Replay, TakesANumberThatIsNoneForAContradiction) {
  const auto policy = place_policy(1);
  std::vector<RecordedDecision> taken = flown(*policy, 1, kSouthWest);
  taken[0].observation[0] = std::nanf("");
  EXPECT_NE(last_contradiction(*policy, taken, kSouthWest), Contradiction::kNone);
}

}  // namespace
}  // namespace earshot::explain
