// The core compiled for a microcontroller: EARSHOT_CAPACITY_PROFILE=kMicrocontroller.

#include "firmware/config/capacities.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "firmware/core/crc32.hpp"
#include "firmware/policy/format/policy_format.hpp"
#include "firmware/policy/ocean_belief/ocean_belief.hpp"
#include "firmware/runtime/runtime.hpp"
#include "tests/firmware/runtime/mission_rig.hpp"

namespace earshot::config {
namespace {

using messages::MissionState;
using messages::Order;

static_assert(kProfile == Profile::kMicrocontroller);
// Of a Cortex-M7's 128 KiB of tightly coupled memory.
static_assert(sizeof(runtime::Runtime) <= 128 * 1024);
static_assert(sizeof(policy::OceanBelief) + sizeof(policy::OceanTables) <= 64 * 1024);

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
  std::ranges::fill(policy->network.layer(2).bias, 0.0F);
  policy->observation.belief.cells_north = 25;
  policy->observation.belief.cells_east = 25;
  ASSERT_TRUE(policy::has_valid_shape(policy->observation.belief));
  EXPECT_EQ(steps_of_a_mission(*policy), 100);
}

/// 32 oceans that fall by 1 to 4.1 dB a kilometre, in steps of 300 m, and a source that is heard in one of them from four sides.
TEST(CapacitiesOfAMicrocontroller, HoldABeliefInManyOceansInCellsOfOneKilometre) {
  policy::BeliefModel model;
  model.area_size = {Meters{25'000}, Meters{25'000}};
  model.cells_north = 25;
  model.cells_east = 25;
  ASSERT_EQ(model.actions.push_back({1, 0}), Status::kOk);
  const auto snr_db = [](int table, Meters range) { return 40.0 - (1.0 + 0.1 * table) * range.value / 1'000.0; };
  policy::OceanTables tables;
  tables.range_step = Meters{300};
  tables.range_count = 120;
  for (int k = 0; k < 32; ++k) {
    policy::OceanTable table;
    for (std::size_t i = 0; i < 120; ++i) table.snr_half_db[i] = policy::to_half_db(snr_db(k, static_cast<double>(i) * tables.range_step));
    ASSERT_EQ(tables.tables.push_back(table), Status::kOk);
  }
  const NorthEast source{Meters{16'500}, Meters{7'500}};
  const auto belief = std::make_unique<policy::OceanBelief>();
  belief->start(model, tables);
  for (int measurement = 0; measurement < 20; ++measurement) {
    const NorthEast place{Meters{1'000.0 + 20'000.0 * (measurement % 2)}, Meters{1'000.0 + 1'150.0 * measurement}};
    belief->update(model, tables, place, {.snr = Decibels{snr_db(20, range_between(place, source))}});
  }
  EXPECT_LT(range_between(belief->summary().likeliest, source).value, 1'500.0);
}

std::vector<std::uint8_t> shipped(const std::string& name) {
  std::ifstream stream(std::filesystem::path(EARSHOT_SOURCE_DIR) / "policy/frozen" / name, std::ios::binary);
  const std::vector<char> text{std::istreambuf_iterator<char>(stream), {}};
  return {text.begin(), text.end()};
}

TEST(CapacitiesOfAMicrocontroller, RefuseThePolicyThatShipsForAVehicleComputersFinerBelief) {
  const std::vector<std::uint8_t> bytes = shipped("shipped.policy");
  const auto policy = std::make_unique<policy::FrozenPolicy>();
  policy::PolicyComplaint complaint;
  EXPECT_NE(policy::parse(bytes, *policy, complaint), Status::kOk);
  EXPECT_EQ(complaint.fault, policy::PolicyFault::kBadShape);
  EXPECT_EQ(complaint.section, policy::kBeliefSection);
}

/// fixed_source.policy with 256 units in its first layer of two: 256 * 3, 64 * 257 and 8 * 65 numbers, of 4 bytes.
TEST(CapacitiesOfAMicrocontroller, RefuseALargerNetworkWithItsSize) {
  std::vector<std::uint8_t> bytes = shipped("fixed_source.policy");
  const auto policy = std::make_unique<policy::FrozenPolicy>();
  policy::PolicyComplaint complaint;
  ASSERT_EQ(policy::parse(bytes, *policy, complaint), Status::kOk);
  ASSERT_EQ(policy->network.hidden_sizes, (std::array<std::size_t, 3>{64, 64}));
  bytes[28] = 0;
  bytes[29] = 1;
  const std::size_t checksum = bytes.size() - policy::kSignatureSize - 4;
  const std::uint32_t crc = crc32(std::span(bytes).first(checksum));
  for (unsigned i = 0; i < 4; ++i) bytes[checksum + i] = static_cast<std::uint8_t>(crc >> (8U * i));
  EXPECT_EQ(policy::parse(bytes, *policy, complaint), Status::kFull);
  EXPECT_EQ(complaint.fault, policy::PolicyFault::kTooLarge);
  EXPECT_EQ(complaint.size, 70'944U);
}

/// Three layers of 32 units each fill a block of 64 places.
TEST(CapacitiesOfAMicrocontroller, HoldThreeSmallLayersAndNotThreeOfSixtyFourUnits) {
  policy::Network network;
  network.observation_size = 62;
  network.action_count = 8;
  network.hidden_sizes = {32, 32, 32};
  EXPECT_TRUE(policy::fits(network));
  network.hidden_sizes = {64, 64, 64};
  EXPECT_FALSE(policy::fits(network));
  network.hidden_sizes = {64, 64};
  EXPECT_TRUE(policy::fits(network));
}

}  // namespace
}  // namespace earshot::config
