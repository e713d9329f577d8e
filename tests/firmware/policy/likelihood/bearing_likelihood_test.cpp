#include "firmware/policy/likelihood/bearing_likelihood.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "tests/firmware/policy/belief/belief_rig.hpp"

namespace earshot::policy {
namespace {

using messages::Bearing;

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr Meters kPoint{0.0};

constexpr Bearing bearing(double direction_deg, double deviation_deg) {
  return {.direction = Radians{direction_deg * kDegree}, .deviation = Radians{deviation_deg * kDegree}};
}

constexpr Bearing about(Bearing bearing, double axis_deg) {
  bearing.mirror_axis = Radians{axis_deg * kDegree};
  return bearing;
}

NorthEast toward(double direction_deg, double range_m = 5'000.0) {
  return at(range_m * std::cos(direction_deg * kDegree), range_m * std::sin(direction_deg * kDegree));
}

/// 2 pi times the wrapped normal distribution by its Fourier series: 1 + 2 sum exp(-k^2 s^2 / 2) cos(k x).
double by_its_series(double off_deg, double deviation_deg) {
  const double s = deviation_deg * kDegree;
  double sum = 1.0;
  for (int k = 1; k < 400; ++k) sum += 2.0 * std::exp(-0.5 * k * k * s * s) * std::cos(k * off_deg * kDegree);
  return sum;
}

TEST(BearingLikelihood, IsTheWrappedNormalDistributionAsItsFourierSeriesHasIt) {
  for (const double deviation_deg : {3.0, 10.0, 22.0, 23.0, 45.0, 90.0, 113.0, 135.0, 180.0}) {
    const BearingLikelihood likelihood(bearing(350.0, deviation_deg), kPoint, 0.0F);
    for (double off = -180.0; off <= 180.0; off += 7.5) {
      // Turns that are left out hold 1e-5; a float's own 6e-8 of the peak is less.
      EXPECT_NEAR(double{likelihood.at(toward(350.0 + off))}, by_its_series(off, deviation_deg), 3e-5) << deviation_deg << " " << off;
    }
  }
}

TEST(BearingLikelihood, IsHalfToEitherSideOfAnArraysAxisWhereLeftAndRightCannotBeToldApart) {
  const BearingLikelihood plain(bearing(50.0, 10.0), kPoint, 0.0F);
  const BearingLikelihood ambiguous(about(bearing(50.0, 10.0), 20.0), kPoint, 0.0F);  // and 350 degrees
  for (const double off : {-30.0, -12.0, 0.0, 7.0, 25.0}) {
    // The image is 60 degrees, six deviations, from the bearing: at most 1e-2 of its peak at 25 degrees towards it.
    EXPECT_NEAR(double{ambiguous.at(toward(50.0 + off))}, double{ambiguous.at(toward(350.0 - off))}, 1e-5) << off;
  }
  EXPECT_NEAR(double{ambiguous.at(toward(50.0))}, 0.5 * double{plain.at(toward(50.0))}, 1e-5);
  EXPECT_NEAR(double{ambiguous.at(toward(350.0))}, 0.5 * double{plain.at(toward(50.0))}, 1e-5);
}

TEST(BearingLikelihood, LeavesAShareToBearingsThatFollowNoModel) {
  const BearingLikelihood sure(bearing(0.0, 10.0), kPoint, 0.0F);
  const BearingLikelihood doubting(bearing(0.0, 10.0), kPoint, 0.25F);
  EXPECT_NEAR(double{doubting.at(toward(180.0))}, 0.25, 1e-6);
  EXPECT_NEAR(double{doubting.at(toward(0.0))}, 0.75 * double{sure.at(toward(0.0))} + 0.25, 1e-5);
}

TEST(BearingLikelihood, IsSmearedByTheWidthThatACellIsSeenUnder) {
  // A cell of 1 km, 2 km away: the standard deviation across it is 1000 / sqrt(12) = 288.7 m, 8.2703 degrees; with 10 degrees 12.9768.
  const BearingLikelihood likelihood(bearing(90.0, 10.0), Meters{1'000.0}, 0.0F);
  EXPECT_NEAR(double{likelihood.at(toward(90.0, 2'000.0))}, by_its_series(0.0, 12.9768), 1e-3);
  EXPECT_NEAR(double{likelihood.at(toward(110.0, 2'000.0))}, by_its_series(20.0, 12.9768), 1e-3);
}

TEST(BearingLikelihood, SaysNothingOfTheCellThatTheVehicleIsIn) {
  const BearingLikelihood likelihood(bearing(90.0, 1.0), Meters{500.0}, 0.0F);
  // As wide as it gets, half a turn: 1 + 2 exp(-pi^2 / 2) cos x = 1 +- 0.0144.
  for (const NorthEast way : {at(0.0, 0.0), at(0.0, 40.0), at(0.0, -40.0)}) EXPECT_NEAR(double{likelihood.at(way)}, 1.0, 0.015);
}

/// The bits are those that the definition gives in Python's double precision, rounded to float.
TEST(BearingLikelihood, HasTheSameBitsOnEveryMachine) {
  const BearingLikelihood likelihood(about(bearing(33.0, 10.0), 12.0), Meters{500.0}, 0.02F);
  EXPECT_EQ(std::bit_cast<std::uint32_t>(likelihood.at(at(3'000.0, 1'000.0))), 1'076'861'444U);
  EXPECT_EQ(std::bit_cast<std::uint32_t>(likelihood.at(at(4'000.0, -300.0))), 1'086'797'072U);
}

}  // namespace
}  // namespace earshot::policy
