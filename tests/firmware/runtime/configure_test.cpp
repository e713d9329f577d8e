// What a vehicle refuses to fly.
#include <gtest/gtest.h>

#include <limits>
#include <memory>

#include "tests/firmware/not_finite.hpp"
#include "tests/firmware/runtime/mission_rig.hpp"

namespace earshot::runtime {
namespace {

using tests::kNan;

TEST(Configure, RefusesAMissionThatContradictsItself) {
  config::Mission mission = paper_mission();
  mission.max_depth = Meters{100};
  EXPECT_EQ(Rig(*policy_that_goes(kNorthward), mission).configured, Status::kOutOfRange);
}

TEST(Configure, RefusesAPolicyTrainedWithAnotherStepLength) {
  const auto policy = policy_that_goes(kNorthward);
  policy->step_length = Meters{500};
  EXPECT_EQ(Rig(*policy).configured, Status::kOutOfRange);
}

TEST(Configure, RefusesAPolicyTrainedInAnAreaOfAnotherSize) {
  config::Mission mission = paper_mission();
  mission.operating_area.north_east = mission.operating_area.south_west + at(50000, 50000);
  EXPECT_EQ(Rig(*policy_that_goes(kNorthward), mission).configured, Status::kOutOfRange);
}

TEST(Configure, RefusesAPolicyTrainedWithAnotherDetectionThreshold) {
  config::Mission mission = paper_mission();
  mission.detection_threshold = Decibels{12};
  EXPECT_EQ(Rig(*policy_that_goes(kNorthward), mission).configured, Status::kOutOfRange);
}

TEST(Configure, RefusesAnEmptyPolicyAndOneWhoseSizesContradictEachOther) {
  const auto policy = policy_that_goes(kNorthward);
  policy->observation.spec.clear();
  policy->actions.clear();
  EXPECT_EQ(Rig(*policy).configured, Status::kMalformed);
  const auto crooked = policy_that_goes(kNorthward);
  crooked->network.action_count = 5;
  EXPECT_EQ(Rig(*crooked).configured, Status::kMalformed);
}

TEST(Configure, RefusesAPolicyOfWeightsThatAreNoNumbersOrCouldOverflow) {
  const auto policy = policy_that_goes(kNorthward);
  policy->network.layer(2).bias[1] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(Rig(*policy).configured, Status::kOutOfRange);
  policy->network.layer(2).bias[1] = 2e30F;
  EXPECT_EQ(Rig(*policy).configured, Status::kOutOfRange);
}

TEST(Configure, RefusesAPolicyWhoseGoldenTrajectoriesItDoesNotRepeatAndStaysInStandby) {
  const auto policy = frozen(*policy_that_believes());
  policy->golden[1][5].logits[3] += 1e-6F;
  Rig rig(*policy_that_goes(kNorthward));
  EXPECT_EQ(rig.runtime->configure(paper_mission(), *policy, *paper_oceans()), Status::kCorrupt);
  rig.sail(Order::kStart);
  EXPECT_EQ(rig.sail().health.state, MissionState::kStandby);
  EXPECT_EQ(rig.counters().commands_refused, 1U);
}

/// What configuring says to tables after a change to them.
template <class Change>
Status configured_with_tables(const policy::FrozenPolicy& policy, Change change) {
  const auto tables = paper_oceans();
  change(*tables);
  return Rig(policy, paper_mission(), *tables).configured;
}

TEST(Configure, RefusesOceanTablesThatDoNotCoverItsMission) {
  const auto policy = policy_that_believes();
  EXPECT_EQ(configured_with_tables(*policy, [](policy::OceanTables&) {}), Status::kOk);
  const auto refused = [&policy](auto change) { return configured_with_tables(*policy, change) == Status::kOutOfRange; };
  EXPECT_TRUE(refused([](policy::OceanTables& tables) { tables.receiver_depth = Meters{200}; })) << "the mission goes to 300 m";
  EXPECT_TRUE(refused([](policy::OceanTables& tables) { tables.frequency = Hertz{35}; })) << "the mission's source has 20 Hz";
  EXPECT_TRUE(refused([](policy::OceanTables& tables) { tables.range_count = 90; })) << "35.04 km, and the diagonal has 35.36";
  EXPECT_FALSE(refused([](policy::OceanTables& tables) { tables.range_count = 91; })) << "35.43 km";
  EXPECT_TRUE(refused([](policy::OceanTables& tables) { tables.tables.clear(); }));
  EXPECT_TRUE(refused([](policy::OceanTables& tables) { tables.tables[2].prior = std::numeric_limits<float>::quiet_NaN(); }));
}

TEST(Configure, AsksForTablesOfTheMissionsOwnFrequency) {
  config::Mission mission = paper_mission();
  mission.source_frequency = Hertz{35};
  const auto tables = paper_oceans();
  EXPECT_EQ(Rig(*policy_that_believes(), mission, *tables).configured, Status::kOutOfRange);
  tables->frequency = Hertz{35};
  EXPECT_EQ(Rig(*policy_that_believes(), mission, *tables).configured, Status::kOk);
}

TEST(Configure, AsksForNoTablesWhereThePolicySeesNoBelief) {
  EXPECT_EQ(configured_with_tables(*policy_that_goes(kNorthward), [](policy::OceanTables& tables) { tables.tables.clear(); }), Status::kOk);
  EXPECT_EQ(configured_with_tables(*policy_that_wanders(), [](policy::OceanTables& tables) { tables.frequency = Hertz{kNan}; }),
            Status::kOk);
}

TEST(Configure, LeavesInStandbyWhoHasNoTablesForItsMission) {
  Rig rig(*policy_that_believes());
  ASSERT_EQ(rig.runtime->configure(paper_mission(), *frozen(*policy_that_believes()), *std::make_unique<policy::OceanTables>()),
            Status::kOutOfRange);
  rig.sail(Order::kStart);
  EXPECT_EQ(rig.sail().health.state, MissionState::kStandby);
  EXPECT_EQ(rig.counters().commands_refused, 1U);
}

TEST(Configure, ForgetsAnEarlierMission) {
  Rig rig(*policy_that_goes(kNorthward));
  rig.sail(Order::kStart);
  ASSERT_EQ(rig.state(), MissionState::kSearch);
  ASSERT_EQ(rig.runtime->configure(paper_mission(), *frozen(*policy_that_goes(kEastward)), *paper_oceans()), Status::kOk);
  EXPECT_EQ(rig.sail().health.state, MissionState::kStandby);
  EXPECT_EQ(rig.sail(Order::kStart).decision->action, kEastward);
}

}  // namespace
}  // namespace earshot::runtime
