#include "policy/evaluate/time_to_find.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace earshot::evaluate {
namespace {

using search::EpisodeEnd;
using search::EpisodeRecord;

EpisodeRecord found_after(std::uint32_t steps) {
  return {.steps = steps, .end = EpisodeEnd::kFound};
}

TEST(TimeToFind, IsASearchsStepsWhereAllFound) {
  const std::vector<EpisodeRecord> records{found_after(40), found_after(10), found_after(30), found_after(20)};
  const TimeToFind t = time_to_find(records, 100);
  EXPECT_EQ(t.lower_quartile, 10.0) << "by then one of four had found";
  EXPECT_EQ(t.median, 20.0);
  EXPECT_EQ(t.upper_quartile, 30.0);
  EXPECT_EQ(t.restricted_mean, 25.0);
}

TEST(TimeToFind, IsThatByWhichAtLeastTheShareHadFound) {
  const TimeToFind t = time_to_find(std::vector<EpisodeRecord>{found_after(10), found_after(20), found_after(30)}, 100);
  EXPECT_EQ(t.lower_quartile, 10.0);
  EXPECT_EQ(t.median, 20.0) << "by the first only a third had";
  EXPECT_EQ(t.upper_quartile, 30.0) << "by the second only two thirds had";
}

TEST(TimeToFind, NeverComesForASearchThatDidNotFindHoweverSoonItEnded) {
  const std::vector<EpisodeRecord> records{found_after(10),
                                           {.steps = 3, .end = EpisodeEnd::kLeftDomain},
                                           {.steps = 100, .end = EpisodeEnd::kTimeLimit},
                                           {.steps = 50, .end = EpisodeEnd::kLeftDomain}};
  const TimeToFind t = time_to_find(records, 100);
  EXPECT_EQ(t.lower_quartile, 10.0);
  EXPECT_TRUE(std::isinf(t.median)) << "half of them never found";
  EXPECT_TRUE(std::isinf(t.upper_quartile));
  EXPECT_EQ(t.restricted_mean, 77.5) << "(10 + 3 * 100) / 4";
}

TEST(TimeToFind, IsNoShorterForAPolicyThatGivesUpWhereItIsHard) {
  const std::vector<EpisodeRecord> searches_on{found_after(10), found_after(90)};
  const std::vector<EpisodeRecord> gives_up{found_after(10), {.steps = 12, .end = EpisodeEnd::kLeftDomain}};
  EXPECT_GT(time_to_find(gives_up, 100).restricted_mean, time_to_find(searches_on, 100).restricted_mean);
}

TEST(TimeToFind, HasItsMedianWhereJustHalfFound) {
  const std::vector<EpisodeRecord> records{found_after(7), {.steps = 100, .end = EpisodeEnd::kTimeLimit}};
  EXPECT_EQ(time_to_find(records, 100).median, 7.0);
}

TEST(Pace, IsAStepsLengthByTheVehiclesSpeed) {
  const sonar::SnrCurve curve{Meters{1'000.0}, std::vector<float>(40, 20.0F)};
  search::SearchSettings settings;
  settings.step_length = Meters{1'500.0};
  settings.max_steps = 60;
  search::World world(settings, curve);
  world.conditions.vehicle_speed = MetersPerSecond{3.0};
  EXPECT_EQ(pace_of(world).step_s, 500.0);
  EXPECT_EQ(pace_of(world).max_steps, 60U);
}

}  // namespace
}  // namespace earshot::evaluate
