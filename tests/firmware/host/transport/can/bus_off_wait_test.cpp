#include "firmware/host/transport/can/bus_off_wait.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace earshot::host {
namespace {

TEST(BusOffWait, IsTwiceAsLongEachTimeUpToHalfAMinute) {
  BusOffWait wait;
  Time now{};
  std::vector<double> lengths_s;
  for (int i = 0; i < 7; ++i) {
    wait.begin(now);
    lengths_s.push_back(wait.length().to_seconds());
    EXPECT_FALSE(wait.ends(Time{now.us + wait.length().us - 1}));
    EXPECT_TRUE(wait.is_under_way());
    now = now + wait.length();
    EXPECT_TRUE(wait.ends(now));
    EXPECT_FALSE(wait.is_under_way());
    EXPECT_FALSE(wait.ends(now)) << "it is over once";
  }
  EXPECT_EQ(lengths_s, (std::vector<double>{1, 2, 4, 8, 16, 30, 30}));
}

TEST(BusOffWait, BeginsAnewAfterAMinuteOnTheBus) {
  BusOffWait wait;
  wait.begin(Time{});
  EXPECT_TRUE(wait.ends(Time{1'000'000}));
  wait.begin(Time{61'000'000});
  EXPECT_EQ(wait.length(), Duration::seconds(2));
  EXPECT_TRUE(wait.ends(Time{63'000'000}));
  wait.begin(Time{123'000'001});
  EXPECT_EQ(wait.length(), Duration::seconds(1));
}

TEST(BusOffWait, EndsWhenTheClockIsSetBack) {
  BusOffWait wait;
  wait.begin(Time{1'000'000'000});
  EXPECT_TRUE(wait.ends(Time{5}));
}

}  // namespace
}  // namespace earshot::host
