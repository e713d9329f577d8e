// What a Runtime makes of a belief that says "found", or that explains nothing.

#include <gtest/gtest.h>

#include <memory>
#include <optional>

#include "firmware/guidance/sweep.hpp"
#include "tests/firmware/runtime/mission_rig.hpp"

namespace earshot::runtime {
namespace {

/// 50 dB at the source, and 1 dB less every 393.7 m, as in one_ocean().
Decibels snr_at(NorthEast place, NorthEast source) {
  return Decibels{50.0 - range_between(place, source).value / 393.7};
}

struct FoundRig : Rig {
  explicit FoundRig(const config::Mission& mission) : Rig(*policy_that_advises(), mission, *one_ocean()) {}

  /// A second of a search for a source that is heard as the tables say.
  const Outputs& sail_for(NorthEast source, std::optional<Order> order = std::nullopt) {
    snr = snr_at(position, source);
    return sail(order);
  }
};

config::Mission mission_that(bool ends_when_found) {
  config::Mission mission = paper_mission();
  mission.ends_when_found = ends_when_found;
  return mission;
}

constexpr int kHours = 14 * 3600;

TEST(FoundOnBoard, EndsTheMissionThatIsToEndWithItAndItsLastDecisionSaysWhy) {
  const NorthEast source = at(9'300, 7'400);
  FoundRig rig(mission_that(true));
  rig.sail_for(source, Order::kStart);
  std::optional<messages::Decision> last = rig.outputs.decision;
  for (int i = 0; i < kHours && rig.state() == MissionState::kSearch; ++i) {
    rig.sail_for(source);
    if (rig.outputs.decision) last = rig.outputs.decision;
  }
  EXPECT_EQ(rig.state(), MissionState::kDone);
  EXPECT_EQ(rig.end_reason(), EndReason::kFound);
  EXPECT_LT(range_between(rig.position, source).value, 1'500.0);
  ASSERT_TRUE(last && last->found);
  EXPECT_GE(last->found->probability, 0.5F);
  EXPECT_LT(range_between(last->found->likeliest, source).value, 1'500.0) << "in the mission's frame, whose corner is not the origin";
  EXPECT_EQ(rig.outputs.health.steps_taken, last->step);
  EXPECT_TRUE(rig.outputs.health.is_found);
}

TEST(FoundOnBoard, LetsAMissionGoOnThatIsToGoOn) {
  const NorthEast source = at(9'300, 7'400);
  FoundRig rig(mission_that(false));
  rig.sail_for(source, Order::kStart);
  bool has_declared = false;
  for (int i = 0; i < kHours && !has_declared; ++i) has_declared = rig.sail_for(source).health.is_found;
  EXPECT_TRUE(has_declared);
  EXPECT_EQ(rig.state(), MissionState::kSearch);
  for (int i = 0; i < 1'000; ++i) rig.sail_for(source);
  EXPECT_EQ(rig.state(), MissionState::kSearch);
}

TEST(ModelMismatchOnBoard, MakesTheVehicleSweepTheAreaToTheEnd) {
  // Northward, and as loud wherever the vehicle is as no ocean that it knows of: no source swims as fast.
  Rig rig(*policy_that_believes(), paper_mission(), *one_ocean());
  rig.snr = Decibels{40.0};
  rig.sail(Order::kStart);
  int decisions = 1;
  while (decisions < 40 && rig.state() == MissionState::kSearch && !rig.outputs.health.is_sweeping) {
    rig.sail_to_decision();
    ++decisions;
  }
  ASSERT_TRUE(rig.outputs.health.is_sweeping);
  EXPECT_GE(rig.outputs.health.mismatch_bits, policy::kSweepLevel_bits);
  const config::Mission mission = paper_mission();
  guidance::Sweep sweep({.area = mission.operating_area, .margin = mission.edge_margin, .step_length = mission.step_length}, rig.position);
  const auto policy = policy_that_believes();
  for (int i = 0; i < 20; ++i) {
    ASSERT_TRUE(rig.outputs.decision && rig.outputs.decision->sweeping) << i;
    const std::size_t action = sweep.next(rig.outputs.decision->position, {policy->actions.begin(), policy->actions.size()}).action;
    EXPECT_EQ(rig.outputs.decision->action, action) << i;
    rig.sail_to_decision();
  }
}

TEST(SilenceOnBoard, MakesTheVehicleSweepTheAreaUntilItHearsSomething) {
  // A dead hydrophone, where the source would be heard to 15 km.
  Rig rig(*policy_that_advises(), paper_mission(), *one_ocean());
  rig.snr = Decibels{-30.0};
  rig.sail(Order::kStart);
  for (int i = 0; i < 60 && rig.state() == MissionState::kSearch && !rig.outputs.health.is_sweeping; ++i) rig.sail_to_decision();
  ASSERT_TRUE(rig.outputs.decision && rig.outputs.decision->sweeping);
  EXPECT_TRUE(rig.outputs.health.is_sweeping);
  EXPECT_LT(rig.outputs.health.mismatch_bits, messages::kMismatchThreshold_bits);
  rig.sail_to_decision();
  EXPECT_TRUE(rig.outputs.health.is_sweeping);
  rig.snr = Decibels{12.0};
  rig.sail_to_decision();
  EXPECT_FALSE(rig.outputs.health.is_sweeping);
  ASSERT_TRUE(rig.outputs.decision);
  EXPECT_FALSE(rig.outputs.decision->sweeping);
}

TEST(ModelMismatchOnBoard, IsNoneOfAPolicyWithoutABelief) {
  Rig rig(*policy_that_goes(kNorthward));
  rig.snr = Decibels{45.0};
  rig.sail(Order::kStart);
  for (int i = 0; i < 12 && rig.state() == MissionState::kSearch; ++i) rig.sail_to_decision();
  EXPECT_FALSE(rig.outputs.health.is_sweeping);
  EXPECT_FALSE(rig.outputs.health.is_found);
  EXPECT_EQ(rig.outputs.health.mismatch_bits, 0.0F);
}

}  // namespace
}  // namespace earshot::runtime
