#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <span>

#include "firmware/core/math.hpp"
#include "tests/firmware/runtime/mission_rig.hpp"

namespace earshot::runtime {
namespace {

// GIVEN a mission under way, WHEN a bit of the runtime's memory flips between two turns, THEN it is noticed before it is used.

std::span<unsigned char> bytes_of(Runtime& runtime) {
  return {reinterpret_cast<unsigned char*>(&runtime), sizeof(Runtime)};
}

/// The first place from `from` on.
template <class Value>
std::size_t place_of(Runtime& runtime, const Value& value, std::size_t from = 0) {
  const std::span<unsigned char> bytes = bytes_of(runtime);
  for (std::size_t i = from; i + sizeof value <= bytes.size(); ++i) {
    if (std::memcmp(&bytes[i], &value, sizeof value) == 0) return i;
  }
  ADD_FAILURE() << "it stands nowhere";
  return 0;
}

void flip(Runtime& runtime, std::size_t bit) {
  bytes_of(runtime)[bit / 8] = static_cast<unsigned char>(bytes_of(runtime)[bit / 8] ^ (1U << (bit % 8)));
}

config::Mission mission_with_marks() {
  config::Mission mission = paper_mission();
  mission.max_depth = Meters{321.125};
  mission.safety.vehicle.ascent_speed = MetersPerSecond{1.0625};
  return mission;
}

TEST(MemoryFault, InALimitEndsTheMissionAndBringsTheVehicleUpAsSlowlyAsItCan) {
  Rig rig = under_way(mission_with_marks());
  flip(*rig.runtime, 8 * place_of(*rig.runtime, 321.125) + 62);  // the highest bit of its exponent: a depth without end
  rig.sail();
  EXPECT_EQ(rig.state(), MissionState::kAbort);
  EXPECT_EQ(rig.end_reason(), EndReason::kMemoryFault);
  EXPECT_EQ(rig.outputs.health.authority, messages::Authority::kAbort);
  ASSERT_TRUE(rig.outputs.setpoint);
  EXPECT_EQ(rig.outputs.setpoint->depth.value, 0.0);
  EXPECT_EQ(rig.outputs.setpoint->speed.value, 1.0625);
}

TEST(MemoryFault, SendsAVehicleThatMustMoveToComeUpRoundACircle) {
  Rig rig = under_way(mission_with_marks());
  flip(*rig.runtime, 8 * place_of(*rig.runtime, 321.125) + 62);
  rig.sail();
  ASSERT_EQ(rig.end_reason(), EndReason::kMemoryFault);
  const NorthEast from = rig.position;
  double farthest_m = 0.0;
  for (int i = 0; i < 1000; ++i) {
    rig.sail();
    farthest_m = std::max(farthest_m, range_between(rig.position, from).value);
  }
  EXPECT_NEAR(farthest_m, 40.0, 1.0) << "straight on it would be 1 km";
}

TEST(MemoryFault, InTheTurningCircleMakesItWide) {
  config::Mission mission = mission_with_marks();
  mission.safety.vehicle.turn_radius = Meters{12.5};
  Rig rig = under_way(mission);
  flip(*rig.runtime, 8 * place_of(*rig.runtime, 12.5) + 61);
  rig.sail();
  const double heading = rig.outputs.setpoint->heading.value;
  rig.sail();
  EXPECT_NEAR(wrap_to_pi(Radians{rig.outputs.setpoint->heading.value - heading}).value, 1.0625 / 100.0, 1e-6);
}

TEST(MemoryFault, InTheSpeedToComeUpWithCommandsTheLowerOfTheTwo) {
  for (const bool is_in_copy : {false, true}) {
    for (std::size_t bit = 0; bit < 64; ++bit) {
      Rig rig = under_way(mission_with_marks());
      const std::size_t first = place_of(*rig.runtime, 1.0625);
      const std::size_t copy = place_of(*rig.runtime, 1.0625, sizeof(Runtime) / 2);
      flip(*rig.runtime, 8 * (is_in_copy ? copy : first) + bit);
      rig.sail();
      EXPECT_EQ(rig.end_reason(), EndReason::kMemoryFault);
      ASSERT_TRUE(rig.outputs.setpoint);
      EXPECT_GE(rig.outputs.setpoint->speed.value, 0.0) << bit;
      EXPECT_LE(rig.outputs.setpoint->speed.value, 1.0625) << bit;
      if (bit >= 62) {
        EXPECT_EQ(rig.outputs.setpoint->speed.value, 1.0625) << "one is impossible: the other is right";
      }
    }
  }
}

TEST(MemoryFault, EndsTheMissionForGood) {
  Rig rig = under_way(mission_with_marks());
  const std::size_t bit = 8 * place_of(*rig.runtime, 321.125);
  flip(*rig.runtime, bit);
  rig.sail();
  flip(*rig.runtime, bit);  // as it was
  for (int i = 0; i < 10; ++i) rig.sail(i == 5 ? std::optional(Order::kStart) : std::nullopt);
  EXPECT_EQ(rig.state(), MissionState::kAbort);
  EXPECT_EQ(rig.end_reason(), EndReason::kMemoryFault);
}

TEST(MemoryFault, StopsTheCountOfTurns) {
  Rig rig = under_way(mission_with_marks());
  const std::uint64_t turn = rig.outputs.health.turn;
  flip(*rig.runtime, 8 * place_of(*rig.runtime, 321.125));
  for (int i = 0; i < 3; ++i) rig.sail();
  EXPECT_EQ(rig.outputs.health.turn, turn);
}

TEST(MemoryFault, InTheMarkThatMemoryIsIntactIsOne) {
  Rig rig = under_way(mission_with_marks());
  flip(*rig.runtime, 8 * place_of(*rig.runtime, std::uint64_t{0x5A3C'96E1'0F78'B42D}) + 17);
  rig.sail();
  EXPECT_EQ(rig.state(), MissionState::kAbort);
  EXPECT_EQ(rig.end_reason(), EndReason::kMemoryFault);
}

/// The lowest bit of every byte of state and of what it is compared with: a flag among them says whether the vehicle is commanded.
TEST(MemoryFault, NeitherTakesAVehicleNorLeavesOneAlone) {
  constexpr std::size_t kState = 14'000;  // bytes at the end
  for (const bool is_searching : {false, true}) {
    Rig rig = is_searching ? under_way(mission_with_marks()) : Rig(*policy_that_goes(kNorthward), mission_with_marks());
    if (!is_searching) rig.sail();
    const auto untouched = std::make_unique<Runtime>(*rig.runtime);
    for (std::size_t byte = sizeof(Runtime) - kState; byte < sizeof(Runtime); ++byte) {
      *rig.runtime = *untouched;
      flip(*rig.runtime, 8 * byte);
      EXPECT_EQ(rig.runtime->step(rig.now).setpoint.has_value(), is_searching) << byte;
    }
  }
}

TEST(MemoryFault, IsForgottenByAMissionThatIsConfiguredAnew) {
  Rig rig = under_way(mission_with_marks());
  flip(*rig.runtime, 8 * place_of(*rig.runtime, 321.125));
  rig.sail();
  ASSERT_EQ(rig.runtime->configure(paper_mission(), *frozen(*policy_that_goes(kNorthward)), *paper_oceans()), Status::kOk);
  EXPECT_EQ(rig.runtime->step(rig.now).health.state, MissionState::kStandby);
}

TEST(MemoryFault, BeforeASearchSaysNothingToTheAutopilot) {
  Rig rig(*policy_that_goes(kNorthward), mission_with_marks());
  rig.sail();
  flip(*rig.runtime, 8 * place_of(*rig.runtime, 321.125));
  rig.sail();
  EXPECT_EQ(rig.state(), MissionState::kAbort);
  EXPECT_FALSE(rig.outputs.setpoint);
}

TEST(MemoryFault, InALimitIsNoticedBeforeAnOperatorTightensAnother) {
  Rig rig = under_way(mission_with_marks());
  flip(*rig.runtime, 8 * place_of(*rig.runtime, 321.125));  // a depth that is possible, and not the mission's
  messages::OperatorCommand command = command_of(Order::kTighten, rig.now, ++rig.commands);
  command.limits.max_speed = MetersPerSecond{1};
  rig.take(command);
  rig.sail();
  EXPECT_EQ(rig.end_reason(), EndReason::kMemoryFault);
}

TEST(MemoryFault, InThePolicyIsNoticedBeforeASearchTakesTheVehicle) {
  auto policy = policy_that_goes(kNorthward);
  policy->network.layer(0).bias[3] = 0.123456F;
  Rig rig(*policy, mission_with_marks());
  rig.sail();
  flip(*rig.runtime, 8 * place_of(*rig.runtime, 0.123456F) + 12);
  rig.sail(Order::kStart);
  EXPECT_EQ(rig.state(), MissionState::kAbort);
  EXPECT_EQ(rig.end_reason(), EndReason::kMemoryFault);
  EXPECT_FALSE(rig.outputs.setpoint);
}

TEST(MemoryFault, InThePolicyIsNoticedByTheNextDecision) {
  auto policy = policy_that_goes(kNorthward);
  policy->network.layer(0).bias[3] = 0.123456F;
  Rig rig = under_way(paper_mission(), *policy);
  flip(*rig.runtime, 8 * place_of(*rig.runtime, 0.123456F) + 12);
  for (int i = 0; i < 400; ++i) rig.sail();
  EXPECT_EQ(rig.state(), MissionState::kSearch) << "nobody has used it";
  rig.sail_to_decision();
  EXPECT_EQ(rig.end_reason(), EndReason::kMemoryFault);
  EXPECT_FALSE(rig.outputs.decision);
}

TEST(MemoryFault, InWhatTheSearchRemembersIsNoticedBeforeItRefinesOn) {
  Rig rig(*policy_that_believes());
  rig.sail(Order::kStart);
  ASSERT_TRUE(rig.outputs.decision && rig.outputs.decision->belief);
  flip(*rig.runtime, 8 * place_of(*rig.runtime, rig.outputs.decision->belief->spread) + 3);  // it stands in the belief's summary
  rig.sail();
  EXPECT_EQ(rig.end_reason(), EndReason::kMemoryFault);
}

TEST(MemoryFault, InWhatTheSearchRemembersIsNoticedByTheNextDecision) {
  Rig rig(*policy_that_believes());
  rig.sail(Order::kStart);
  ASSERT_TRUE(rig.outputs.decision && rig.outputs.decision->belief);
  const Meters spread = rig.outputs.decision->belief->spread;
  for (int i = 0; i < 100; ++i) rig.sail();                    // until nothing is left to refine
  flip(*rig.runtime, 8 * place_of(*rig.runtime, spread) + 3);  // it stands in the belief's summary
  rig.sail();
  EXPECT_EQ(rig.state(), MissionState::kSearch) << "nobody has used it";
  rig.sail_to_decision();
  EXPECT_EQ(rig.end_reason(), EndReason::kMemoryFault);
  EXPECT_FALSE(rig.outputs.decision);
}

TEST(MemoryFault, InTheOceanTablesIsNoticedByTheNextDecision) {
  const auto tables = paper_oceans();
  tables->tables[1].prior = 0.123456F;
  Rig rig(*policy_that_believes(), paper_mission(), *tables);
  rig.sail(Order::kStart);
  ASSERT_TRUE(rig.outputs.decision);
  for (int i = 0; i < 100; ++i) rig.sail();  // until nothing is left to refine
  flip(*rig.runtime, 8 * place_of(*rig.runtime, 0.123456F) + 12);
  rig.sail();
  EXPECT_EQ(rig.state(), MissionState::kSearch) << "nobody has used it";
  rig.sail_to_decision();
  EXPECT_EQ(rig.end_reason(), EndReason::kMemoryFault);
  EXPECT_FALSE(rig.outputs.decision);
}

/// Every 97th bit of all that there is: each is noticed in this turn, or is the policy's, the tables', the search memory's or nobody's.
TEST(MemoryFault, AnywhereBreaksNoLimit) {
  const auto untouched = std::make_unique<Runtime>();
  Rig rig = under_way(mission_with_marks());
  *untouched = *rig.runtime;
  std::size_t noticed = 0;
  std::size_t tried = 0;
  for (std::size_t bit = 0; bit < 8 * sizeof(Runtime); bit += 997) {
    ++tried;
    *rig.runtime = *untouched;
    flip(*rig.runtime, bit);
    const Outputs outputs = rig.runtime->step(rig.now);
    ASSERT_TRUE(outputs.setpoint) << bit;
    EXPECT_GE(outputs.setpoint->depth.value, 0.0) << bit;
    EXPECT_LE(outputs.setpoint->depth.value, 321.125) << bit;
    EXPECT_GE(outputs.setpoint->speed.value, 0.0) << bit;
    EXPECT_LE(outputs.setpoint->speed.value, 2.0) << bit;
    if (outputs.health.end_reason == EndReason::kMemoryFault) ++noticed;
  }
  // Mission and state, each twice: a fortieth of it, whose most is room for a large network. The rest waits for the next decision.
  EXPECT_GT(noticed, tried / 50);
}

}  // namespace
}  // namespace earshot::runtime
