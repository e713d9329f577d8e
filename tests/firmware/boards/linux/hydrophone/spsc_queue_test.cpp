#include "firmware/boards/linux/hydrophone/spsc_queue.hpp"

#include <gtest/gtest.h>

#include <thread>

namespace earshot::board {
namespace {

TEST(SpscQueue, GivesValuesInTheirOrderAndHasRoomForNoMoreThanItsSize) {
  SpscQueue<int, 3> waiting;
  int value = 0;
  EXPECT_FALSE(waiting.take(value));
  for (const int put : {1, 2, 3}) EXPECT_TRUE(waiting.put(put));
  EXPECT_FALSE(waiting.put(4));
  ASSERT_TRUE(waiting.take(value));
  EXPECT_EQ(value, 1);
  EXPECT_TRUE(waiting.put(5));
  for (const int expected : {2, 3, 5}) {
    ASSERT_TRUE(waiting.take(value));
    EXPECT_EQ(value, expected);
  }
  EXPECT_FALSE(waiting.take(value));
}

TEST(SpscQueue, LosesNothingBetweenTwoThreads) {
  constexpr int kValues = 200'000;
  SpscQueue<int, 16> waiting;
  std::thread putting([&waiting] {
    for (int i = 0; i < kValues;) {
      if (waiting.put(i)) {
        ++i;
      } else {
        std::this_thread::yield();
      }
    }
  });
  for (int expected = 0; expected < kValues;) {
    int value = -1;
    if (!waiting.take(value)) {
      std::this_thread::yield();
      continue;
    }
    ASSERT_EQ(value, expected);
    ++expected;
  }
  putting.join();
}

}  // namespace
}  // namespace earshot::board
