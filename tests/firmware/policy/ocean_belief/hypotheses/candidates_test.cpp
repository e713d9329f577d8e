#include "firmware/policy/ocean_belief/hypotheses/candidates.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <vector>

#include "tests/firmware/policy/ocean_belief/ocean_rig.hpp"

namespace earshot::policy {
namespace {

class CandidatesTest : public testing::Test {
 protected:
  CandidatesTest() {
    for (int k = 0; k < 40; ++k) add_table(tables, 1.0F, [](double) { return 10.0; });
    for (std::size_t i = 0; i < kRetainedHypotheses; ++i) {
      retained.hypotheses[i] = {.table = static_cast<std::uint8_t>(i), .level = 5};
      retained.shares[i] = 1.0F / static_cast<float>(kRetainedHypotheses);
    }
  }

  static bool is_drifting(const Hypothesis& h) { return !h.drift.is_none(); }

  RetainedShares retained{};
  OceanTables tables = no_tables(1);
  Pcg32 random{3};
};

TEST_F(CandidatesTest, AreNoneThatIsRetainedAndNoneTwice) {
  for (const Trial trial : {Trial::kAtRest, Trial::kMoving, Trial::kDrifting}) {
    for (int i = 0; i < 200; ++i) {
      const std::array<Hypothesis, kLanes> candidates = draw_candidates(retained, tables, trial, random);
      for (std::size_t k = 0; k < kLanes; ++k) {
        EXPECT_FALSE(retained.holds(candidates[k]));
        EXPECT_EQ(std::count(candidates.begin(), candidates.end(), candidates[k]), 1);
      }
    }
  }
}

TEST_F(CandidatesTest, MoveOrDriftAsTheTrialSays) {
  retained.hypotheses[3].drift = {.north = 4};
  for (int i = 0; i < 200; ++i) {
    for (const Hypothesis& h : draw_candidates(retained, tables, Trial::kAtRest, random)) EXPECT_TRUE(h.mobility == 0 && !is_drifting(h));
    for (const Hypothesis& h : draw_candidates(retained, tables, Trial::kMoving, random)) EXPECT_TRUE(h.mobility > 0 && !is_drifting(h));
    for (const Hypothesis& h : draw_candidates(retained, tables, Trial::kDrifting, random)) EXPECT_TRUE(is_drifting(h));
  }
}

TEST_F(CandidatesTest, OfDriftsAreOneHypothesisButForThem) {
  int of_one_retained = 0;
  int moving = 0;
  for (int i = 0; i < 4'000; ++i) {
    const std::array<Hypothesis, kLanes> candidates = draw_candidates(retained, tables, Trial::kDrifting, random);
    for (Hypothesis h : candidates) {
      h.drift = candidates[0].drift;
      ASSERT_EQ(h, candidates[0]);
    }
    Hypothesis h = candidates[0];
    h.drift = {};
    of_one_retained += retained.holds(h) ? 1 : 0;
    moving += h.mobility > 0 ? 1 : 0;
  }
  EXPECT_GT(of_one_retained, 0.7 * 4'000 - 5 * 29);  // sqrt(4000 * 0.7 * 0.3) = 29; and some that are like one are another
  EXPECT_LT(of_one_retained, 0.85 * 4'000);
  EXPECT_NEAR(moving, 0.25 * 0.3 * 4'000, 5 * 17);  // those like one, a quarter of the times
}

TEST_F(CandidatesTest, DriftHalfOfTheTimesLikeOneThatIsRetained) {
  retained.hypotheses[7].drift = {.north = -11, .east = 2};
  retained.shares[7] = 1e-12F;  // next to nothing, and still the only one
  int alike = 0;
  for (int i = 0; i < 1'000; ++i) {
    for (const Hypothesis& h : draw_candidates(retained, tables, Trial::kDrifting, random))
      alike += std::max(std::abs(h.drift.north + 11), std::abs(h.drift.east - 2)) <= 3 ? 1 : 0;
  }
  // Of half of 8000 all but the fifth that would be currents too fast, and those that would be retained or twice; of the others 4 %.
  EXPECT_GT(alike, 0.35 * 8'000);
  EXPECT_LT(alike, 0.45 * 8'000);
}

TEST_F(CandidatesTest, TryDriftsTheMoreOftenTheLikelierTheyAre) {
  const auto trials = [this](Trial of) {
    int count = 0;
    for (int i = 0; i < 10'000; ++i) count += draw_trial(retained, random) == of ? 1 : 0;
    return count;
  };
  EXPECT_EQ(retained.drifting(), 0.0F);
  EXPECT_NEAR(trials(Trial::kDrifting), 3'000, 5 * 46);
  EXPECT_NEAR(trials(Trial::kMoving), 0.25 * 7'000, 5 * 38);
  for (std::size_t i = 0; i < kRetainedHypotheses; i += 2) retained.hypotheses[i].drift = {.east = 1};
  EXPECT_FLOAT_EQ(retained.drifting(), 0.5F);
  EXPECT_NEAR(trials(Trial::kDrifting), 5'500, 5 * 50);
}

}  // namespace
}  // namespace earshot::policy
