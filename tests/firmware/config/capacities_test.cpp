// The core compiled for a microcontroller: EARSHOT_CAPACITY_PROFILE=kMicrocontroller.

#include "firmware/config/capacities.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <vector>

#include "firmware/policy/format/policy_format.hpp"
#include "firmware/runtime/runtime.hpp"
#include "tests/firmware/runtime/mission_rig.hpp"

namespace earshot::config {
namespace {

using messages::MissionState;
using messages::Order;

static_assert(kProfile == Profile::kMicrocontroller);
// Of a Cortex-M7's 128 KiB of tightly coupled memory.
static_assert(sizeof(runtime::Runtime) <= 81 * 1024);

std::uint32_t steps_of_a_mission(const policy::FrozenPolicy& policy) {
  runtime::Rig rig(policy);
  rig.sail(Order::kStart);
  while (rig.sail().health.state == MissionState::kSearch) {
  }
  return rig.outputs.health.steps_taken;
}

TEST(CapacitiesOfAMicrocontroller, HoldAPolicyOfTwoLayersOfSixtyFourUnitsForAWholeMission) {
  EXPECT_EQ(steps_of_a_mission(*runtime::policy_that_wanders()), 100);
}

TEST(CapacitiesOfAMicrocontroller, HoldABeliefInCellsOfOneKilometreForAWholeMission) {
  const auto policy = runtime::policy_that_believes();
  policy->draw = policy::ActionDraw::kSampled;  // as long as it goes north alone it ends at the edge
  policy->network.output.bias = {};
  policy->observation.belief.cells_north = 25;
  policy->observation.belief.cells_east = 25;
  ASSERT_TRUE(policy::has_valid_shape(policy->observation.belief));
  EXPECT_EQ(steps_of_a_mission(*policy), 100);
}

TEST(CapacitiesOfAMicrocontroller, RefuseThePolicyThatShipsForAVehicleComputersFinerBelief) {
  std::ifstream stream(std::filesystem::path(EARSHOT_SOURCE_DIR) / "policy/frozen/shipped.policy", std::ios::binary);
  const std::vector<char> text{std::istreambuf_iterator<char>(stream), {}};
  const std::vector<std::uint8_t> bytes(text.begin(), text.end());
  const auto policy = std::make_unique<policy::FrozenPolicy>();
  policy::PolicyComplaint complaint;
  EXPECT_NE(policy::parse(bytes, *policy, complaint), Status::kOk);
  EXPECT_EQ(complaint.fault, policy::PolicyFault::kBadShape);
  EXPECT_EQ(complaint.section, policy::kBeliefSection);
}

}  // namespace
}  // namespace earshot::config
