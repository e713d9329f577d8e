#include "sim/annotation/score.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "firmware/core/random.hpp"

namespace earshot::annotation {
namespace {

TEST(Score, CountsOneHitForEachPair) {
  // By hand: 10-11 is met by 10.5-12, 20-21 by nothing, 30-31 by 32.9-33 within 2 s; 50-51 is heard in vain.
  const Score score = annotation::score({{10, 11}, {20, 21}, {30, 31}}, {{10.5, 12}, {32.9, 33}, {50, 51}}, 2.0, 0.5);
  EXPECT_EQ(score.hits, 2U);
  EXPECT_EQ(score.misses(), 1U);
  EXPECT_EQ(score.false_alarms(), 1U);
  EXPECT_DOUBLE_EQ(score.recall(), 2.0 / 3.0);
  EXPECT_DOUBLE_EQ(score.precision(), 2.0 / 3.0);
  EXPECT_DOUBLE_EQ(score.false_alarms_per_hour(), 2.0);
}

TEST(Score, IsNotImprovedByOneDetectionOverEverything) {
  EXPECT_EQ(score({{10, 11}, {20, 21}, {30, 31}}, {{0, 100}}, 2.0, 1.0).hits, 1U);
}

TEST(Score, IsNotImprovedByManyDetectionsOfOneCall) {
  const Score score = annotation::score({{10, 20}}, {{10, 11}, {12, 13}, {14, 15}}, 2.0, 1.0);
  EXPECT_EQ(score.hits, 1U);
  EXPECT_EQ(score.false_alarms(), 2U);
}

TEST(Score, HasATolerancesEdgeWhereItSays) {
  EXPECT_EQ(score({{10, 11}}, {{13, 14}}, 2.0, 1.0).hits, 1U);
  EXPECT_EQ(score({{10, 11}}, {{13.001, 14}}, 2.0, 1.0).hits, 0U);
  EXPECT_EQ(score({{10, 11}}, {{7, 7.999}}, 2.0, 1.0).hits, 0U);
}

TEST(Score, SaysThatThereIsNoShareOfNothing) {
  const Score nothing = score({}, {}, 2.0, 1.0);
  EXPECT_TRUE(std::isnan(nothing.recall()));
  EXPECT_TRUE(std::isnan(nothing.precision()));
  EXPECT_EQ(nothing.false_alarms_per_hour(), 0.0);
}

/// The best of all orders in which detections may choose: each takes the first truth that it meets in that order.
std::size_t best_of_every_order(const std::vector<Interval>& truth, const std::vector<Interval>& found, double tolerance_s) {
  std::vector<std::size_t> order(truth.size());
  std::iota(order.begin(), order.end(), 0U);
  std::size_t best = 0;
  do {  // every order of truths against detections one by one holds a greatest matching
    std::size_t hits = 0;
    for (std::size_t i = 0; i < std::min(truth.size(), found.size()); ++i) {
      const Interval& t = truth[order[i]];
      const Interval& f = found[i];
      if (f.begin_s - t.end_s <= tolerance_s && t.begin_s - f.end_s <= tolerance_s) ++hits;
    }
    best = std::max(best, hits);
  } while (std::ranges::next_permutation(order).found);
  return best;
}

TEST(Score, OfManyAlikeTakesNoLongerThanOfOthers) {
  // Each against each would be 10^11 comparisons, minutes.
  const std::vector<Interval> alike(300'000, {1.0, 2.0});
  EXPECT_EQ(score(alike, alike, 0.0, 1.0).hits, 300'000U);
  std::vector<Interval> apart(100'000);
  for (std::size_t i = 0; i < apart.size(); ++i) apart[i] = {10.0 + static_cast<double>(i), 10.5 + static_cast<double>(i)};
  std::vector<Interval> under_one = apart;
  under_one.push_back({0.0, 200'000.0});
  EXPECT_EQ(score(apart, under_one, 0.0, 1.0).hits, 100'000U);
}

TEST(Score, FindsAsManyPairsAsEveryOrderOfPairingCan) {
  Pcg32 random(7);
  const auto some = [&random] {
    std::vector<Interval> intervals(6);
    for (Interval& interval : intervals) {
      interval.begin_s = static_cast<double>(random.next() % 30);
      interval.end_s = interval.begin_s + static_cast<double>(random.next() % 6);
    }
    return intervals;
  };
  for (int i = 0; i < 300; ++i) {
    const std::vector<Interval> truth = some();
    const std::vector<Interval> found = some();
    ASSERT_EQ(score(truth, found, 1.0, 1.0).hits, best_of_every_order(truth, found, 1.0)) << "case " << i;
  }
}

}  // namespace
}  // namespace earshot::annotation
