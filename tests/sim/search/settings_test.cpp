#include "sim/search/settings.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace earshot::search {
namespace {

constexpr NorthEast at(double north_m, double east_m) {
  return {Meters{north_m}, Meters{east_m}};
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
