#include "sim/parallel/ordered_tasks.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <cstdlib>
#include <numeric>
#include <stdexcept>
#include <string>
#include <system_error>
#include <thread>
#include <vector>

namespace earshot::parallel {
namespace {

TEST(OrderedTasks, DoesEveryTaskOnceAndHandsTheGroupsOverInOrder) {
  std::vector<std::atomic<int>> times(60);
  std::vector<std::size_t> order;
  run_in_order(
      {.groups = 20, .tasks_per_group = 3, .threads = 4, .window = 5}, [&](std::size_t task) { ++times[task]; },
      [&](std::size_t group) {
        for (std::size_t task = 3 * group; task < 3 * group + 3; ++task) EXPECT_EQ(times[task], 1);
        order.push_back(group);
      });
  std::vector<std::size_t> expected(20);
  std::iota(expected.begin(), expected.end(), 0U);
  EXPECT_EQ(order, expected);
}

TEST(OrderedTasks, BeginsNoGroupBeyondTheWindowOfTheOldestOne) {
  std::atomic<std::size_t> handed_over{0};
  std::atomic<bool> beyond{false};
  run_in_order(
      {.groups = 200, .tasks_per_group = 1, .threads = 3, .window = 2},
      [&](std::size_t group) { beyond = beyond || group >= handed_over + 2; },
      // Counted before the ledger knows, so that a worker can only be found too early, never too late.
      [&](std::size_t group) { handed_over = group + 1; });
  EXPECT_FALSE(beyond);
}

TEST(OrderedTasks, ThrowsWhatTheEarliestFailingTaskThrew) {
  for (int repeat = 0; repeat < 50; ++repeat) {
    std::vector<std::size_t> finished;
    try {
      run_in_order(
          {.groups = 100, .tasks_per_group = 1, .threads = 4, .window = 100},
          [](std::size_t task) {
            if (task % 10 == 7) throw std::runtime_error(std::to_string(task));
          },
          [&](std::size_t group) { finished.push_back(group); });
      FAIL();
    } catch (const std::runtime_error& e) {
      EXPECT_STREQ(e.what(), "7");
    }
    EXPECT_LE(finished.size(), 7U);
  }
}

TEST(OrderedTasks, StopsWhenAGroupCannotBeTaken) {
  std::atomic<int> done{0};
  EXPECT_THROW(run_in_order(
                   {.groups = 1000, .tasks_per_group = 1, .threads = 2, .window = 10}, [&](std::size_t) { ++done; },
                   [](std::size_t group) {
                     if (group == 3) throw std::runtime_error("disk full");
                   }),
               std::runtime_error);
  EXPECT_LE(done, 13);  // the window past the last one handed over
}

/// Runs in a process of its own, whose address space cannot hold the stacks of so many threads.
void ask_for_more_threads_than_there_are() {
  const rlimit little{.rlim_cur = 256UL << 20U, .rlim_max = 256UL << 20U};
  if (setrlimit(RLIMIT_AS, &little) != 0) std::_Exit(1);
  alarm(20);  // a deadlock ends by a signal
  try {
    run_in_order(
        {.groups = 1000, .tasks_per_group = 1, .threads = 1000, .window = 1}, [](std::size_t) {}, [](std::size_t) {});
  } catch (const std::system_error&) {
    std::_Exit(7);
  }
  std::_Exit(0);
}

TEST(OrderedTasks, ThrowsWhenThereAreNoMoreThreadsInsteadOfWaitingForThoseItHas) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "a sanitizer needs more addresses than the limit leaves";
#endif
  EXPECT_EXIT(ask_for_more_threads_than_there_are(), testing::ExitedWithCode(7), "");
}

TEST(OrderedTasks, HasNothingToDoForNoGroups) {
  run_in_order(
      {.groups = 0, .tasks_per_group = 5, .threads = 2, .window = 1}, [](std::size_t) { FAIL(); }, [](std::size_t) { FAIL(); });
}

}  // namespace
}  // namespace earshot::parallel
