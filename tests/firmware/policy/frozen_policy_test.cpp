#include "firmware/policy/frozen_policy.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "tests/firmware/policy/made_up_policy.hpp"

namespace earshot::policy {
namespace {

/// A mission that small_policy() was trained for, its corners where a sum of doubles rounds.
config::Mission fitting_mission() {
  config::Mission mission;
  mission.operating_area.south_west = {.north = Meters{-5000.1}, .east = Meters{1000.3}};
  mission.operating_area.north_east = {.north = Meters{19999.9}, .east = Meters{27000.3}};
  mission.step_length = Meters{1000};
  mission.detection_threshold = Decibels{-3.5};
  return mission;
}

Mismatch mismatch_after(const std::function<void(config::Mission&)>& change) {
  config::Mission mission = fitting_mission();
  change(mission);
  return mismatch(*small_policy(), mission);
}

TEST(FrozenPolicy, FitsAMissionWhereverItsAreaLies) {
  EXPECT_EQ(mismatch(*small_policy(), fitting_mission()), Mismatch::kNone);
}

TEST(FrozenPolicy, DoesNotFitAMissionOfAnotherStepAreaOrThreshold) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(mismatch_after([](auto& mission) { mission.step_length = Meters{999}; }), Mismatch::kStepLength);
  EXPECT_EQ(mismatch_after([](auto& mission) { mission.operating_area.north_east.north += Meters{0.1}; }), Mismatch::kAreaSize);
  EXPECT_EQ(mismatch_after([](auto& mission) { mission.operating_area.north_east.east -= Meters{0.1}; }), Mismatch::kAreaSize);
  EXPECT_EQ(mismatch_after([](auto& mission) { mission.operating_area.south_west.east = Meters{kNan}; }), Mismatch::kAreaSize);
  EXPECT_EQ(mismatch_after([](auto& mission) { mission.detection_threshold = Decibels{-3.4}; }), Mismatch::kDetectionThreshold);
  EXPECT_EQ(mismatch_after([](auto& mission) {
              mission.listening = {config::Listening::kMean, Duration::seconds(15)};
            }),
            Mismatch::kListening);
}

}  // namespace
}  // namespace earshot::policy
