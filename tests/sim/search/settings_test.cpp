#include "sim/search/settings.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace earshot::search {
namespace {

constexpr NorthEast at(double north_m, double east_m) {
  return {Meters{north_m}, Meters{east_m}};
}
constexpr Decibels kHeard{10.0};  // the threshold itself counts as detected
constexpr Decibels kUnheard{9.99};

TEST(StepReward, IsZeroOnADetectionAndMinusOneWithoutInTheInterior) {
  const SearchSettings paper;
  EXPECT_EQ(step_reward(paper, at(12'000, 12'000), kHeard), 0.0);
  EXPECT_EQ(step_reward(paper, at(12'000, 12'000), kUnheard), -1.0);
}

TEST(StepReward, TakesAHundredAtTheEdgeAndHalfOfItHalfwayThroughTheBorder) {
  const SearchSettings paper;
  EXPECT_EQ(step_reward(paper, at(12'000, 0), kHeard), -100.0);
  EXPECT_EQ(step_reward(paper, at(24'500, 12'000), kHeard), -50.0);
  EXPECT_EQ(step_reward(paper, at(24'500, 12'000), kUnheard), -51.0);
}

TEST(StepReward, IsFreeOfPenaltyExactlyAtTheInnerEdgeOfTheBorder) {
  EXPECT_EQ(step_reward({}, at(1'000, 12'000), kHeard), 0.0);
}

TEST(StepReward, GrowsBeyondTheEdgePenaltyOutside) {
  EXPECT_EQ(step_reward({}, at(25'500, 12'000), kUnheard), -151.0);
}

TEST(StepReward, CountsANearCornerOnceByItsNearestEdge) {
  EXPECT_EQ(step_reward({}, at(250, 500), kHeard), -75.0);
}

TEST(CompassDirections, RunClockwiseFromNorthWithExactCardinals) {
  const ActionTable table = compass_directions(8);
  ASSERT_EQ(table.size(), 8U);
  EXPECT_EQ(table[0], (UnitNorthEast{1.0, 0.0}));
  EXPECT_EQ(table[2], (UnitNorthEast{0.0, 1.0}));
  EXPECT_EQ(table[4], (UnitNorthEast{-1.0, 0.0}));
  EXPECT_EQ(table[6], (UnitNorthEast{0.0, -1.0}));
  const double half = std::sqrt(0.5);
  EXPECT_NEAR(table[3].north, -half, 1e-12);  // south-east; core's sine is good to 1e-12
  EXPECT_NEAR(table[3].east, half, 1e-12);
}

TEST(CompassDirections, AreOfLengthOneForEveryCount) {
  for (std::size_t count = 1; count <= config::kMaxActions; ++count) {
    for (const UnitNorthEast& d : compass_directions(count)) EXPECT_NEAR(d.north * d.north + d.east * d.east, 1.0, 1e-12);  // as above
  }
}

TEST(SearchSettingsCheck, AcceptsThePapersProblem) {
  EXPECT_EQ(check({}), Status::kOk);
}

TEST(SearchSettingsCheck, RefusesEachNumberOutsideItsRange) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  auto refused = [](auto change) {
    SearchSettings s;
    change(s);
    return check(s) == Status::kOutOfRange;
  };
  EXPECT_TRUE(refused([](SearchSettings& s) { s.direction_count = 0; }));
  EXPECT_TRUE(refused([](SearchSettings& s) { s.direction_count = config::kMaxActions + 1; }));
  EXPECT_TRUE(refused([](SearchSettings& s) { s.max_steps = 0; }));
  EXPECT_TRUE(refused([](SearchSettings& s) { s.step_length = Meters{0.0}; }));
  EXPECT_TRUE(refused([](SearchSettings& s) { s.border_width = Meters{-1.0}; }));
  EXPECT_TRUE(refused([nan](SearchSettings& s) { s.detection_threshold = Decibels{nan}; }));
  EXPECT_TRUE(refused([nan](SearchSettings& s) { s.source.east = Meters{nan}; }));
  EXPECT_TRUE(refused([](SearchSettings& s) { s.start_region.north_east.east = Meters{25'001.0}; }));
  EXPECT_TRUE(refused([](SearchSettings& s) { s.domain.north_east.north = Meters{-1.0}; }));
}

TEST(SearchSettingsCheck, RefusesADomainInWhichEveryChangingSourceIsWithinReachOfEveryStart) {
  SearchSettings settings;
  settings.placement = SourcePlacement::kChanging;
  settings.domain = {{Meters{0.0}, Meters{0.0}}, {Meters{600.0}, Meters{600.0}}};  // a diagonal of 849 m, a step of 1000 m
  settings.start_region = settings.domain;
  EXPECT_EQ(check(settings), Status::kOutOfRange);
  settings.step_length = Meters{800.0};
  EXPECT_EQ(check(settings), Status::kOk);
}

TEST(SearchSettingsCheck, RefusesAStartRegionThatLiesWhollyWithinReachOfTheSource) {
  SearchSettings s;
  s.start_region = {at(9'900, 9'900), at(10'100, 10'100)};
  EXPECT_EQ(check(s), Status::kOutOfRange);
}

TEST(LooksOnLeg, AreOneASecondBackFromItsEndAsFarAsWindowAndLegReach) {
  const auto window = [](std::int64_t length_s) {
    return config::ListeningWindow{.listening = config::Listening::kLoudest, .length = Duration::seconds(length_s)};
  };
  EXPECT_EQ(looks_on_leg({}, 500.0), 1U);
  EXPECT_EQ(looks_on_leg(window(1), 500.0), 1U);
  EXPECT_EQ(looks_on_leg(window(15), 500.0), 15U);
  EXPECT_EQ(looks_on_leg(window(120), 50.0), 50U);
  EXPECT_EQ(looks_on_leg(window(120), 50.9), 50U);
  EXPECT_EQ(looks_on_leg(window(120), 0.2), 1U);
}

TEST(CheckSettings, RefusesAWindowThatCannotBeListenedOver) {
  SearchSettings settings;
  settings.listening.length = Duration::seconds(5);  // of the newest
  EXPECT_EQ(check(settings), Status::kOutOfRange);
  settings.listening.listening = config::Listening::kLoudest;
  EXPECT_EQ(check(settings), Status::kOk);
}

}  // namespace
}  // namespace earshot::search
