#include "sim/link/mailbox.hpp"

#include <gtest/gtest.h>

#include <time.h>
#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <thread>
#include <vector>

namespace earshot::link {
namespace {

using namespace std::chrono_literals;

double processor_time_of_this_thread_s() {
  timespec used{};
  (void)clock_gettime(CLOCK_THREAD_CPUTIME_ID, &used);
  return static_cast<double>(used.tv_sec) + 1e-9 * static_cast<double>(used.tv_nsec);
}

TEST(Mailbox, GivesEachValueOnce) {
  Mailbox<int> box;
  int value = 0;
  box.put(7);
  EXPECT_EQ(box.take(value, 0ms), Delivery::kArrived);
  EXPECT_EQ(value, 7);
  EXPECT_EQ(box.take(value, 0ms), Delivery::kNothing);
}

TEST(Mailbox, GivesTheLastValueEvenWhenItIsClosedAlready) {
  Mailbox<int> box;
  int value = 0;
  box.put(7);
  box.close();
  EXPECT_EQ(box.take(value, 0ms), Delivery::kArrived);
  EXPECT_EQ(box.take(value, 0ms), Delivery::kLost);
}

TEST(Mailbox, WakesATakerThatSleeps) {
  Mailbox<int> box;
  std::thread putter([&box] {
    std::this_thread::sleep_for(20ms);
    box.put(7);
  });
  int value = 0;
  EXPECT_EQ(box.take(value, 60s), Delivery::kArrived);
  putter.join();
}

TEST(Mailbox, LeavesTheProcessorToOthersWhileItIsEmpty) {
  Mailbox<int> box;
  int value = 0;
  std::mutex mutex;
  std::condition_variable never;
  const auto processor_time_of_s = [](auto&& wait) {
    const double before_s = processor_time_of_this_thread_s();
    wait();
    return processor_time_of_this_thread_s() - before_s;
  };
  constexpr std::size_t kWaits = 301;
  std::vector<double> taken_s;
  std::vector<double> slept_s;
  for (std::size_t i = 0; i < kWaits; ++i) {
    taken_s.push_back(processor_time_of_s([&] { ASSERT_EQ(box.take(value, 1ms), Delivery::kNothing); }));
    slept_s.push_back(processor_time_of_s([&] {
      std::unique_lock lock(mutex);
      (void)never.wait_for(lock, 1ms);
    }));
  }
  // To fall asleep and wake costs what it costs here and now; looking out for 100 us before that would cost 100 us more. The middle of
  // many waits knows nothing of the few in which the machine did something else.
  std::ranges::nth_element(taken_s, taken_s.begin() + kWaits / 2);
  std::ranges::nth_element(slept_s, slept_s.begin() + kWaits / 2);
  EXPECT_LT(taken_s[kWaits / 2], slept_s[kWaits / 2] + 50e-6);
}

}  // namespace
}  // namespace earshot::link
