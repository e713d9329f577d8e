#include <gtest/gtest.h>
#include <unistd.h>

#include <cstddef>
#include <cstdlib>

#include "tests/firmware/runtime/mission_rig.hpp"

// A trap in place of the heap: while it is set, any allocation of this program ends it with a message.

namespace {
bool trap_is_set = false;

void spring_if_set() {
  if (!trap_is_set) return;
  constexpr char kMessage[] = "heap used while the trap was set\n";
  static_cast<void>(!write(STDERR_FILENO, kMessage, sizeof(kMessage) - 1));
  _exit(3);
}
}  // namespace

extern "C" {
void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t count, std::size_t size);
void* __libc_realloc(void* old, std::size_t size);
void* malloc(std::size_t size) {
  spring_if_set();
  return __libc_malloc(size);
}
void* calloc(std::size_t count, std::size_t size) {
  spring_if_set();
  return __libc_calloc(count, size);
}
void* realloc(void* old, std::size_t size) {
  spring_if_set();
  return __libc_realloc(old, size);
}
}

namespace earshot::runtime {
namespace {

TEST(HeapTrap, SpringsOnAnAllocation) {
  const auto allocate_in_the_trap = [] {
    trap_is_set = true;
    int* volatile kept = new int(1);  // volatile: the compiler may leave out an allocation that nobody looks at
    delete kept;
  };
  EXPECT_EXIT(allocate_in_the_trap(), testing::ExitedWithCode(3), "heap used while the trap was set");
}

void expect_no_heap_in_a_hundred_steps(const policy::FrozenPolicy& policy) {
  Rig rig(policy);
  trap_is_set = true;
  const Status configured = rig.runtime->configure(paper_mission(), policy);
  rig.sail(Order::kStart);
  while (rig.sail().health.state == MissionState::kSearch) {
  }
  trap_is_set = false;
  EXPECT_EQ(configured, Status::kOk);
  EXPECT_EQ(rig.outputs.health.steps_taken, 100U);
}

TEST(Runtime, UsesNoHeapFromConfigurationToTheEndOfAHundredSteps) {
  expect_no_heap_in_a_hundred_steps(*policy_that_wanders());
}

TEST(Runtime, UsesNoHeapForABeliefEither) {
  const auto policy = policy_that_believes();
  policy->draw = policy::ActionDraw::kSampled;  // as long as it goes north alone it ends at the edge
  policy->network.output.bias = {};
  ASSERT_TRUE(policy::needs_belief(policy->observation.spec));
  expect_no_heap_in_a_hundred_steps(*policy);
}

}  // namespace
}  // namespace earshot::runtime
