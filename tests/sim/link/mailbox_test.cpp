#include "sim/link/mailbox.hpp"

#include <gtest/gtest.h>

#include <time.h>
#include <chrono>
#include <thread>

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
  constexpr int kWaits = 300;
  const double before_s = processor_time_of_this_thread_s();
  for (int i = 0; i < kWaits; ++i) ASSERT_EQ(box.take(value, 1ms), Delivery::kNothing);
  // To fall asleep and wake costs some 10 us of the processor; looking out for 100 us before that would cost 100.
  EXPECT_LT(processor_time_of_this_thread_s() - before_s, kWaits * 50e-6);
}

}  // namespace
}  // namespace earshot::link
