#include "firmware/runtime/shadow_copy.hpp"

#include <gtest/gtest.h>

#include <cstddef>

#include "tests/firmware/runtime/mission_rig.hpp"

namespace earshot::runtime {
namespace {

/// Of a search that commands its vehicle.
struct Twins {
  config::Mission mission = paper_mission();
  Progress progress;
  ShadowCopy shadow;

  Twins() {
    progress.arm(mission);
    const Intake::Arrival arrival{.mission = mission, .state = progress.state(), .time = kNow, .port = 1};
    progress.intake.take(arrival, messages::Navigation{.time = kNow, .position = at(7000, 12000), .depth = {}, .heading = {}, .speed = {}});
    progress.intake.take(arrival, messages::SnrMeasurement{.time = kNow, .snr = Decibels{3}});
    shadow.trust(mission, progress);
  }

  void begin() {
    EXPECT_EQ(progress.obey(mission, kNow, command_of(Order::kStart, kNow)), messages::CommandOutcome::kObeyed);
    progress.begin_search(kNow);
    shadow.copy(progress);
  }

  static constexpr Time kNow{1'000'000'000};
};

TEST(ShadowCopy, TrustsWhatIsAsItWas) {
  Twins twins;
  twins.shadow.compare(twins.mission);
  twins.shadow.compare(twins.progress);
  EXPECT_TRUE(twins.shadow.is_trusted());
}

void flip(Progress& progress, std::size_t byte) {
  auto* const bytes = reinterpret_cast<unsigned char*>(&progress);
  bytes[byte] = static_cast<unsigned char>(bytes[byte] ^ 1U);
}

TEST(ShadowCopy, NeverAgainTrustsAProgressOfWhichABitWasFlipped) {
  for (const std::size_t byte : {std::size_t{0}, sizeof(Progress) / 2, sizeof(Progress) - 1}) {
    Twins twins;
    flip(twins.progress, byte);
    twins.shadow.compare(twins.progress);
    EXPECT_FALSE(twins.shadow.is_trusted()) << byte;
    flip(twins.progress, byte);
    twins.shadow.compare(twins.progress);
    EXPECT_FALSE(twins.shadow.is_trusted()) << byte << ", as it was";
  }
}

TEST(ShadowCopy, TrustsNoMissionWithALimitOfItsOwn) {
  Twins twins;
  twins.mission.max_depth = Meters{640};
  twins.shadow.compare(twins.progress);
  EXPECT_TRUE(twins.shadow.is_trusted()) << "the mission was not looked at";
  twins.shadow.compare(twins.mission);
  EXPECT_FALSE(twins.shadow.is_trusted());
}

TEST(ShadowCopy, TrustsAMissionThatWasTightenedAndCopied) {
  Twins twins;
  twins.mission.max_depth = Meters{310};
  twins.shadow.copy(twins.mission);
  twins.shadow.compare(twins.mission);
  EXPECT_TRUE(twins.shadow.is_trusted());
}

TEST(ShadowCopy, TrustsAgainWhatIsNewAltogether) {
  Twins twins;
  twins.shadow.distrust();
  twins.shadow.compare(twins.progress);
  EXPECT_FALSE(twins.shadow.is_trusted()) << "though nothing differs";
  twins.shadow.trust(twins.mission, twins.progress);
  EXPECT_TRUE(twins.shadow.is_trusted());
}

TEST(ShadowCopy, SaysNothingToAnAutopilotThatWasNotCommanded) {
  Twins twins;
  Outputs outputs;
  twins.shadow.bring_up(Twins::kNow, twins.mission, twins.progress, outputs);
  EXPECT_EQ(outputs.health.end_reason, EndReason::kMemoryFault);
  EXPECT_FALSE(outputs.setpoint);
}

/// 1 m/s round 100 m, for 50 s: half a radian. Nobody knows which of the two circles is the vehicle's, nor which of the speeds.
TEST(ShadowCopy, BringsUpAtTheLowerSpeedOfTwoAndRoundAWideCircleWhereTheCopiesDiffer) {
  Twins twins;
  twins.mission.safety.vehicle.ascent_speed = MetersPerSecond{1};
  twins.mission.safety.vehicle.turn_radius = Meters{30};
  twins.shadow.copy(twins.mission);
  twins.begin();
  twins.mission.safety.vehicle.ascent_speed = MetersPerSecond{2};
  twins.mission.safety.vehicle.turn_radius = Meters{15};
  Outputs outputs;
  twins.shadow.bring_up(Time{50'000'000}, twins.mission, twins.progress, outputs);
  ASSERT_TRUE(outputs.setpoint);
  EXPECT_EQ(outputs.setpoint->speed, MetersPerSecond{1});
  EXPECT_NEAR(outputs.setpoint->heading.value, 0.5, 1e-12) << "of rounding";
  EXPECT_EQ(outputs.setpoint->depth, Meters{0});
}

}  // namespace
}  // namespace earshot::runtime
