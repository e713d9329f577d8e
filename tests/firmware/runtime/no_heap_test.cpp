// The core's whole mission within the heap's trap, which has tests of its own: tests/firmware/host/memory/heap_trap_test.cpp.

#include <gtest/gtest.h>

#include "firmware/host/memory/heap_trap.hpp"
#include "tests/firmware/runtime/mission_rig.hpp"

namespace earshot::runtime {
namespace {

void expect_no_heap_in_a_hundred_steps(const policy::FrozenPolicy& policy) {
  const auto complete = frozen(policy);
  const auto tables = paper_oceans();
  Rig rig(policy);
  host::arm_heap_trap();
  const Status configured = rig.runtime->configure(paper_mission(), *complete, *tables);
  rig.sail(Order::kStart);
  while (rig.sail().health.state == MissionState::kSearch) {
  }
  host::disarm_heap_trap();
  EXPECT_EQ(configured, Status::kOk);
  EXPECT_EQ(rig.outputs.health.steps_taken, 100U);
  EXPECT_TRUE(host::heap_uses().empty()) << to_string(host::heap_uses().front());
}

TEST(Runtime, UsesNoHeapFromConfigurationToTheEndOfAHundredSteps) {
  expect_no_heap_in_a_hundred_steps(*policy_that_wanders());
}

TEST(Runtime, UsesNoHeapForABeliefEither) {
  const auto policy = policy_that_believes();
  policy->draw = policy::ActionDraw::kSampled;  // as long as it goes north alone it ends at the edge
  std::ranges::fill(policy->network.layer(2).bias, 0.0F);
  ASSERT_TRUE(policy::needs_belief(policy->observation.spec));
  expect_no_heap_in_a_hundred_steps(*policy);
}

TEST(Runtime, UsesNoHeapForABeliefsOwnAdvice) {
  const auto policy = policy_that_advises();
  policy->draw = policy::ActionDraw::kSampled;
  expect_no_heap_in_a_hundred_steps(*policy);
}

}  // namespace
}  // namespace earshot::runtime
