#include "policy/evaluate/bootstrap.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace earshot::evaluate {
namespace {

/// Rewards 0, -1, ... -9 in turn; every fourth search does not find the source; paths twice the straight line.
std::vector<Flight> flights(std::size_t count) {
  std::vector<Flight> all(count);
  for (std::size_t i = 0; i < count; ++i) {
    all[i].record.reward = -static_cast<double>(i % 10);
    all[i].record.steps = 10;
    all[i].record.end = i % 4 == 0 ? search::EpisodeEnd::kTimeLimit : search::EpisodeEnd::kFound;
    all[i].path_m = 2.0 * static_cast<double>(1 + i % 7);
    all[i].straight_m = static_cast<double>(1 + i % 7);
  }
  return all;
}

TEST(Bootstrap, GivesTheIntervalsOfTheNormalApproximationForManySearches) {
  const Intervals i = bootstrap(flights(2'000), 100, 1);
  // Standard error of the mean: sqrt(8.25 / 2000) = 0.0642; of the steps, 10 with a chance of 0.75 and 100 (the limit) without:
  // 90 sqrt(0.75 * 0.25 / 2000) = 0.871. The ends of a percentile interval from 1000 resamples are themselves uncertain by about 7 % of a
  // standard error, three of that: 0.2 standard errors.
  EXPECT_NEAR(i.mean_reward.low, -4.5 - 1.96 * 0.0642, 0.2 * 0.0642);
  EXPECT_NEAR(i.mean_reward.high, -4.5 + 1.96 * 0.0642, 0.2 * 0.0642);
  EXPECT_NEAR(i.restricted_mean_steps.low, 32.5 - 1.96 * 0.871, 0.2 * 0.871);
  EXPECT_NEAR(i.restricted_mean_steps.high, 32.5 + 1.96 * 0.871, 0.2 * 0.871);
  EXPECT_NEAR(i.path_over_straight.low, 2.0, 1e-12);  // every resample has the same ratio
  EXPECT_NEAR(i.path_over_straight.high, 2.0, 1e-12);
}

TEST(Bootstrap, HasTheMedianBetweenTheEndsOfItsInterval) {
  const Intervals i = bootstrap(flights(1'000), 100, 1);
  EXPECT_LE(i.median_reward.low, -4.5);
  EXPECT_GE(i.median_reward.high, -4.5);
  EXPECT_GE(i.median_reward.low, -6.0);
  EXPECT_LE(i.median_reward.high, -3.0);
}

TEST(Bootstrap, IsTheSameForTheSameSeedAndNotForAnother) {
  EXPECT_EQ(bootstrap(flights(100), 100, 1).mean_reward.low, bootstrap(flights(100), 100, 1).mean_reward.low);
  EXPECT_NE(bootstrap(flights(100), 100, 1).mean_reward.low, bootstrap(flights(100), 100, 2).mean_reward.low);
}

TEST(Bootstrap, EndsBetweenTwoResamplesWithWhatIsThrownThere) {
  struct Stopped {};
  int resamples = 0;
  EXPECT_THROW((void)bootstrap(flights(10), 100, 1,
                               [&] {
                                 if (++resamples == 7) throw Stopped();
                               }),
               Stopped);
  EXPECT_EQ(resamples, 7);
}

TEST(Bootstrap, SaysNothingOfPathsWhenNoneFoundTheSource) {
  std::vector<Flight> lost = flights(50);
  for (Flight& flight : lost) flight.record.end = search::EpisodeEnd::kTimeLimit;
  EXPECT_TRUE(std::isnan(bootstrap(lost, 100, 1).path_over_straight.low));
  EXPECT_TRUE(std::isnan(path_over_straight(lost)));
}

TEST(PathOverStraight, WeighsSearchesByTheirLengthAndLeavesOutThoseThatFoundNothing) {
  std::vector<Flight> some(3);
  some[0] = {.record = {.end = search::EpisodeEnd::kFound}, .path_m = 1'000.0, .straight_m = 50.0};  // began just out of reach
  some[1] = {.record = {.end = search::EpisodeEnd::kFound}, .path_m = 12'000.0, .straight_m = 9'950.0};
  some[2] = {.record = {.end = search::EpisodeEnd::kTimeLimit}, .path_m = 100'000.0, .straight_m = 10'000.0};
  EXPECT_DOUBLE_EQ(path_over_straight(some), 1.3);
}

}  // namespace
}  // namespace earshot::evaluate
