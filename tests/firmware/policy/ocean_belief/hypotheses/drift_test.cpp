#include "firmware/policy/ocean_belief/hypotheses/drift.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <map>
#include <tuple>
#include <vector>

#include "tests/firmware/policy/belief/belief_rig.hpp"

namespace earshot::policy {
namespace {

/// Velocities within 6, and within 14, sixteenths of a step length, without none: Gauss's circle problem (OEIS A000328) less one.
constexpr int kCurrents = 113 - 1;
constexpr int kSwums = 613 - 1;

bool is_possible(const Drift& drift) {
  return std::hypot(drift.north, drift.east) <= (drift.is_current ? 6.0 : 14.0) && (drift.north != 0 || drift.east != 0);
}

std::vector<Drift> all_drifts() {
  std::vector<Drift> all;
  for (int north = -14; north <= 14; ++north) {
    for (int east = -14; east <= 14; ++east) {
      for (const bool is_current : {false, true}) {
        const Drift drift{static_cast<std::int8_t>(north), static_cast<std::int8_t>(east), is_current};
        if (is_possible(drift)) all.push_back(drift);
      }
    }
  }
  return all;
}

double prior_of(const Drift& drift) {
  return std::exp2(log_prior(drift) / 512.0);
}

TEST(DriftPriors, AddUpToOne) {
  double sum = prior_of({});
  for (const Drift& drift : all_drifts()) sum += prior_of(drift);
  EXPECT_NEAR(sum, 1.0, 2e-3);  // three logarithms, each rounded by half of 0.14 % at most
}

TEST(DriftPriors, AreThreeHundredthsOfCurrentsAndMoreThanAQuarterOfNone) {
  EXPECT_NEAR(prior_of({}), 0.275, 1e-3);
  EXPECT_NEAR(prior_of({.north = 3, .is_current = true}), 0.03 / kCurrents, 5e-7);
  EXPECT_NEAR(prior_of({.north = 3}), 0.695 / kSwums, 2e-6);
}

TEST(DriftDraws, TryEveryDriftAsOftenAsAnotherOfItsKind) {
  constexpr int kDraws = 200'000;
  std::map<std::tuple<int, int, bool>, int> counts;
  Pcg32 random(5);
  for (int i = 0; i < kDraws; ++i) {
    const Drift drift = draw_drift(random);
    ASSERT_TRUE(is_possible(drift));
    ++counts[{drift.north, drift.east, drift.is_current}];
  }
  ASSERT_EQ(counts.size(), std::size_t{kCurrents + kSwums});
  for (const auto& [drift, count] : counts) {
    const double expected = 0.5 * kDraws / (std::get<2>(drift) ? kCurrents : kSwums);
    EXPECT_NEAR(count, expected, 5.0 * std::sqrt(expected)) << std::get<0>(drift) << ", " << std::get<1>(drift);
  }
}

TEST(DriftNeighbours, ArePossibleAndMostlyNextToTheirParents) {
  Pcg32 random(6);
  for (const Drift& parent : {Drift{2, -1, true}, Drift{-9, 5, false}}) {
    int near = 0;
    int of_its_kind = 0;
    for (int i = 0; i < 10'000; ++i) {
      const Drift drift = draw_neighbour(parent, random);
      ASSERT_TRUE(is_possible(drift));
      near += std::max(std::abs(drift.north - parent.north), std::abs(drift.east - parent.east)) <= 3 ? 1 : 0;
      of_its_kind += drift.is_current == parent.is_current ? 1 : 0;
    }
    EXPECT_GT(near, 7'500);  // but for a fifth of the swimmers, which are too fast for a current
    EXPECT_GT(of_its_kind, 7'500);
  }
}

TEST(DriftNeighbours, OfTheFastestAreNoFaster) {
  Pcg32 random(7);
  for (int i = 0; i < 10'000; ++i) {
    ASSERT_TRUE(is_possible(draw_neighbour({14, 0, false}, random)));
    ASSERT_TRUE(is_possible(draw_neighbour({0, -6, true}, random)));
    ASSERT_TRUE(is_possible(draw_neighbour({1, 0, true}, random)));
  }
}

TEST(DriftWay, IsSoManySixteenthsOfAStepAMeasurement) {
  BeliefModel model = bare_model(at(10'000, 10'000), 20, 20);
  model.step_length = Meters{800};
  EXPECT_EQ(way_of({.north = 3, .east = -2}, model, 10), at(1'500, -1'000));
  EXPECT_EQ(way_of({.north = 3, .east = -2}, model, 0), at(0, 0));
}

}  // namespace
}  // namespace earshot::policy
