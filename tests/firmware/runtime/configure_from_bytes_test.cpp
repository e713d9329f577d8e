#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "firmware/runtime/runtime.hpp"
#include "tests/firmware/policy/format/unsigned_file.hpp"
#include "tests/firmware/runtime/mission_rig.hpp"

namespace earshot::runtime {
namespace {

using Bytes = std::vector<std::uint8_t>;

/// Of a policy that sees a belief, as its freezer leaves it.
Bytes policy_bytes() {
  return policy::unsigned_file(*frozen(*policy_that_believes()));
}
Bytes tables_bytes() {
  return policy::unsigned_file(*paper_oceans());
}

/// A runtime is larger than a test's stack should hold.
Status configured(const Bytes& policy, const Bytes& tables, const config::Mission& mission = paper_mission()) {
  return std::make_unique<Runtime>()->configure(mission, policy, tables);
}

TEST(ConfigureFromBytes, DecidesAsFromThePolicyAndTablesThatTheyHold) {
  Rig rig(*policy_that_believes());
  Rig other(*policy_that_believes());
  ASSERT_EQ(other.runtime->configure(paper_mission(), policy_bytes(), tables_bytes()), Status::kOk);
  rig.sail(Order::kStart);
  other.sail(Order::kStart);
  for (int leg = 0; leg < 3; ++leg) {
    rig.sail_to_decision();
    other.sail_to_decision();
    ASSERT_TRUE(rig.outputs.decision && other.outputs.decision);
    EXPECT_EQ(rig.outputs.decision->observation, other.outputs.decision->observation);
    EXPECT_EQ(rig.outputs.decision->logits, other.outputs.decision->logits);
    EXPECT_EQ(rig.outputs.decision->action, other.outputs.decision->action);
  }
}

TEST(ConfigureFromBytes, NeedsNoTablesForAPolicyWithoutABelief) {
  EXPECT_EQ(configured(policy::unsigned_file(*frozen(*policy_that_goes(kNorthward))), {}), Status::kOk);
}

TEST(ConfigureFromBytes, RefusesAPolicyWithABitFlipped) {
  Bytes policy = policy_bytes();
  policy[policy.size() / 2] ^= 1U;
  EXPECT_EQ(configured(policy, tables_bytes()), Status::kCorrupt);
}

TEST(ConfigureFromBytes, RefusesTablesWithABitFlippedOrNone) {
  Bytes tables = tables_bytes();
  tables[tables.size() / 2] ^= 1U;
  EXPECT_EQ(configured(policy_bytes(), tables), Status::kCorrupt);
  EXPECT_NE(configured(policy_bytes(), {}), Status::kOk);
}

TEST(ConfigureFromBytes, RefusesTablesOfAnotherDepth) {
  config::Mission deeper = paper_mission();
  deeper.search_depth = Meters{100};
  EXPECT_EQ(configured(policy_bytes(), tables_bytes(), deeper), Status::kOutOfRange);
}

TEST(ConfigureFromBytes, RefusesAPolicyThatThisBuildDoesNotRepeat) {
  const auto policy = frozen(*policy_that_believes());
  policy->golden[0][2].logits[0] += 1.0F;
  EXPECT_EQ(configured(policy::unsigned_file(*policy), tables_bytes()), Status::kCorrupt);
}

TEST(ConfigureFromBytes, FliesNothingAfterARefusal) {
  Rig rig(*policy_that_goes(kNorthward));
  ASSERT_NE(rig.runtime->configure(paper_mission(), Bytes{}, Bytes{}), Status::kOk);
  rig.sail(Order::kStart);
  EXPECT_EQ(rig.sail().health.state, MissionState::kStandby);
}

}  // namespace
}  // namespace earshot::runtime
