#include "sim/pe/depth_grid.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace earshot::pe {
namespace {

const DepthGrid kGrid{.step_m = 2.0, .intervals = 100, .reference_wavenumber_per_m = 0.1, .absorber_top_m = 150.0};

double read(const DepthTap& tap, double (*function)(double)) {
  double sum = 0.0;
  for (std::size_t k = 0; k < DepthTap::kNodes; ++k) sum += tap.weight[k] * function(2.0 * static_cast<double>(tap.node[k]));
  return sum;
}

TEST(DepthTap, IsExactForAFifthDegreePolynomialInTheWater) {
  const auto p = [](double z) { return 1.0 + z * (0.3 + z * (-0.02 + z * (1e-3 + z * (1e-5 - z * 1e-7)))); };
  EXPECT_NEAR(read(tap_at(kGrid, 33.3, 90.0), p), p(33.3), 1e-9);
}

TEST(DepthTap, TakesThePressureAsOddAboutTheSurface) {
  const auto odd = [](double z) { return z - 1e-3 * z * z * z; };
  EXPECT_NEAR(read(tap_at(kGrid, 0.5, 90.0), odd), odd(0.5), 1e-12);
  EXPECT_EQ(read(tap_at(kGrid, 0.0, 90.0), odd), 0.0);
}

TEST(DepthTap, DoesNotReachAcrossTheSeaFloor) {
  const DepthTap above = tap_at(kGrid, 88.5, 90.0);
  const DepthTap below = tap_at(kGrid, 91.0, 90.0);
  for (std::size_t k = 0; k < DepthTap::kNodes; ++k) {
    EXPECT_LE(above.node[k], 45U);
    EXPECT_GE(below.node[k], 45U);
  }
}

}  // namespace
}  // namespace earshot::pe
