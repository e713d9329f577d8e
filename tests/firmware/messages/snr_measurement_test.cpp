#include "firmware/messages/snr_measurement.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace earshot::messages {
namespace {

TEST(SnrMeasurement, IsPossibleUpToSixHundredDecibelsEitherSideOfZero) {
  for (const double snr : {-600.0, -599.9, 0.0, 599.9, 600.0}) EXPECT_TRUE(is_possible_snr(Decibels{snr})) << snr;
  for (const double snr : {-600.1, 600.1, -1e300, 1e300}) EXPECT_FALSE(is_possible_snr(Decibels{snr})) << snr;
}

TEST(SnrMeasurement, IsImpossibleWhenItIsNoNumber) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  for (const double snr : {kInfinity, -kInfinity, std::numeric_limits<double>::quiet_NaN()}) EXPECT_FALSE(is_possible_snr(Decibels{snr}));
}

}  // namespace
}  // namespace earshot::messages
