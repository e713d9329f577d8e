#include "firmware/host/transport/can/arrival.hpp"

#include <gtest/gtest.h>

namespace earshot::host {
namespace {

constexpr Time kSoftware{1'800'000'000'000'000};  // a day in 2027

TEST(CanArrival, IsTheControllersOwnWhereItsClockIsTheHosts) {
  EXPECT_EQ(arrival_of(kSoftware, Time{kSoftware.us - 250}), Time{kSoftware.us - 250});
  EXPECT_EQ(arrival_of(kSoftware, kSoftware), kSoftware);
  EXPECT_EQ(arrival_of(kSoftware, Time{kSoftware.us - 100'000}), Time{kSoftware.us - 100'000});
}

TEST(CanArrival, IsTheKernelsWhereTheControllerCountsFromWhenItWasSwitchedOnOrInAtomicTimeOrDrifts) {
  EXPECT_EQ(arrival_of(kSoftware, Time{73'000'000}), kSoftware);
  EXPECT_EQ(arrival_of(kSoftware, Time{kSoftware.us + 37'000'000}), kSoftware);
  EXPECT_EQ(arrival_of(kSoftware, Time{kSoftware.us + 1}), kSoftware) << "the controller cannot have had it later";
  EXPECT_EQ(arrival_of(kSoftware, Time{kSoftware.us - 100'001}), kSoftware);
}

TEST(CanArrival, IsNeverTheControllersAlone) {
  EXPECT_EQ(arrival_of(std::nullopt, kSoftware), std::nullopt);
  EXPECT_EQ(arrival_of(kSoftware, std::nullopt), kSoftware);
}

}  // namespace
}  // namespace earshot::host
