#include "sim/search/settings.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/firmware/place.hpp"

namespace earshot::search {
namespace {

TEST(SearchSettingsCheck, AcceptsThePapersProblem) {
  EXPECT_EQ(check({}), Status::kOk);
  const SearchSettings paper;
  for (const Rectangle& area : {paper.domain, paper.start_region}) {
    EXPECT_EQ(area.south_west, at(0, 0));
    EXPECT_EQ(area.north_east, at(25'000, 25'000));
  }
}

TEST(SearchSettingsCheck, AcceptsTheLeastAndTheMostOfEachNumber) {
  SearchSettings s;
  s.direction_count = 1;
  s.max_steps = 1;
  s.border_reward = 0.0;
  s.border_width = Meters{1e-3};
  EXPECT_EQ(check(s), Status::kOk);
  s.direction_count = config::kMaxActions;
  EXPECT_EQ(check(s), Status::kOk);
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
  EXPECT_TRUE(refused([nan](SearchSettings& s) { s.step_length = Meters{nan}; }));
  EXPECT_TRUE(refused([](SearchSettings& s) { s.border_width = Meters{-1.0}; }));
  EXPECT_TRUE(refused([](SearchSettings& s) { s.border_width = Meters{0.0}; }));
  EXPECT_TRUE(refused([nan](SearchSettings& s) { s.border_reward = nan; }));
  EXPECT_TRUE(refused([nan](SearchSettings& s) { s.detection_threshold = Decibels{nan}; }));
  EXPECT_TRUE(refused([nan](SearchSettings& s) { s.source.east = Meters{nan}; }));
  EXPECT_TRUE(refused([](SearchSettings& s) { s.start_region.north_east.east = Meters{25'001.0}; }));
  EXPECT_TRUE(refused([](SearchSettings& s) { s.start_region.south_west.north = Meters{-1.0}; }));
  EXPECT_TRUE(refused([](SearchSettings& s) { s.start_region.north_east.east = s.start_region.south_west.east; })) << "no area";
  EXPECT_TRUE(refused([](SearchSettings& s) { s.start_region.north_east.north = s.start_region.south_west.north; }));
  EXPECT_TRUE(refused([](SearchSettings& s) { s.domain.north_east.north = Meters{-1.0}; }));
  EXPECT_TRUE(refused([nan](SearchSettings& s) { s.domain.south_west.east = Meters{nan}; }));
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_TRUE(refused([infinity](SearchSettings& s) { s.domain.south_west.north = Meters{-infinity}; }));
  EXPECT_TRUE(refused([infinity](SearchSettings& s) { s.domain.north_east.east = Meters{infinity}; }));
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

TEST(SearchSettingsCheck, MeasuresRoomForASearchNorthAndEastByTheirOwnSides) {
  // A domain of 900 m north by 1200 m east, whose corners are 1500 m apart, and a start region in each of them.
  SearchSettings s;
  s.placement = SourcePlacement::kChanging;
  s.domain = {at(100, -400), at(1'000, 800)};
  for (const Rectangle& start : {Rectangle{at(100, -400), at(200, -300)}, Rectangle{at(900, 700), at(1'000, 800)},
                                 Rectangle{at(100, 700), at(200, 800)}, Rectangle{at(900, -400), at(1'000, -300)}}) {
    s.start_region = start;
    s.step_length = Meters{1'499.0};
    EXPECT_EQ(check(s), Status::kOk);
    s.step_length = Meters{1'501.0};
    EXPECT_EQ(check(s), Status::kOutOfRange);
  }
  // A fixed source 300 m and 400 m from the start region's nearest edges, 900 m and 1200 m from its furthest.
  s.placement = SourcePlacement::kFixed;
  for (const double north : {-1.0, 1.0}) {
    for (const double east : {-1.0, 1.0}) {
      s.domain = {at(-10'000, -10'000), at(10'000, 10'000)};
      s.source = at(-900 * north, -1'200 * east);
      s.start_region = {at(north > 0 ? -600 : 0, east > 0 ? -800 : 0), at(north > 0 ? 0 : 600, east > 0 ? 0 : 800)};
      s.step_length = Meters{1'499.0};
      EXPECT_EQ(check(s), Status::kOk);
      s.step_length = Meters{1'501.0};
      EXPECT_EQ(check(s), Status::kOutOfRange);
    }
  }
}

TEST(SearchSettingsCheck, RefusesAStartRegionThatLiesWhollyWithinReachOfTheSource) {
  SearchSettings s;
  s.start_region = {at(9'900, 9'900), at(10'100, 10'100)};
  EXPECT_EQ(check(s), Status::kOutOfRange);
}

TEST(MeasurementsOnLeg, AreOneASecondBackFromItsEndAsFarAsWindowAndLegReach) {
  const auto window = [](std::int64_t length_s) {
    return config::ListeningWindow{.listening = config::Listening::kLoudest, .length = Duration::seconds(length_s)};
  };
  EXPECT_EQ(measurements_on_leg({}, 500.0), 1U);
  EXPECT_EQ(measurements_on_leg(window(1), 500.0), 1U);
  EXPECT_EQ(measurements_on_leg(window(15), 500.0), 15U);
  EXPECT_EQ(measurements_on_leg(window(120), 50.0), 50U);
  EXPECT_EQ(measurements_on_leg(window(120), 50.9), 50U);
  EXPECT_EQ(measurements_on_leg(window(120), 0.2), 1U);
}

TEST(CheckSettings, RefusesAWindowThatCannotBeListenedOver) {
  SearchSettings settings;
  settings.listening.length = Duration::seconds(5);  // of the newest
  EXPECT_EQ(check(settings), Status::kOutOfRange);
  settings.listening.listening = config::Listening::kLoudest;
  EXPECT_EQ(check(settings), Status::kOk);
}

TEST(FurthestRange, IsAStepBeyondTheDiagonalOfTheDomainWhereverThatLies) {
  SearchSettings s;
  s.domain = {at(-500, 700), at(2'500, 4'700)};  // 3 km by 4 km
  s.step_length = Meters{250.0};
  EXPECT_EQ(furthest_range(s), Meters{5'250.0});
}

}  // namespace
}  // namespace earshot::search
