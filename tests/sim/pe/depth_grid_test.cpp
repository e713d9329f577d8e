#include "sim/pe/depth_grid.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <span>
#include <vector>

namespace earshot::pe {
namespace {

const DepthGrid kGrid{.step_m = 2.0,
                      .intervals = 100,
                      .reference_wavenumber_per_m = 0.1,
                      .deepest_medium_m = 150.0,
                      .absorber = {.shortest_m = 2.0, .growth = 1.5, .elements = 10}};

/// A sea floor at 91 m, between nodes, over sediment of density 1.8.
const std::vector<Interface> kFloor{{91.0, 1.0, 1.8}};

template <class Function>
double read(const DepthTap& tap, const Function& function) {
  double sum = 0.0;
  for (std::size_t k = 0; k < tap.count; ++k) sum += tap.weight[k] * function(2.0 * static_cast<double>(tap.node[k]));
  return sum;
}

TEST(DepthTap, IsExactForAFifthDegreePolynomialInTheWater) {
  const auto p = [](double z) { return 1.0 + z * (0.3 + z * (-0.02 + z * (1e-3 + z * (1e-5 - z * 1e-7)))); };
  EXPECT_NEAR(read(tap_at(kGrid, 33.3, kFloor), p), p(33.3), 1e-9);
}

TEST(DepthTap, TakesThePressureAsOddAboutTheSurface) {
  const auto odd = [](double z) { return z - 1e-3 * z * z * z; };
  EXPECT_NEAR(read(tap_at(kGrid, 0.5, kFloor), odd), odd(0.5), 1e-12);
  EXPECT_EQ(read(tap_at(kGrid, 0.0, kFloor), odd), 0.0);
}

TEST(DepthTap, DoesNotReachAcrossTheSeaFloor) {
  const DepthTap above = tap_at(kGrid, 88.5, kFloor);
  const DepthTap below = tap_at(kGrid, 92.5, kFloor);
  for (const std::size_t node : std::span(above.node).first(above.count)) EXPECT_LE(node, 45U);
  for (const std::size_t node : std::span(below.node).first(below.count)) EXPECT_GE(node, 46U);
}

TEST(DepthTap, FollowsThePressureAroundItsKinkBetweenTheLastNodeAndTheSeaFloor) {
  // Two polynomials that meet at 91 m with slopes as 1 to 1.8.
  const auto p = [](double z) {
    const double t = 0.1 * (z - 91.0);
    return z <= 91.0 ? 2.0 + t * (1.0 + t * (0.3 - 0.1 * t)) : 2.0 + t * (1.8 + t * (-0.2 + 0.05 * t));
  };
  for (const double depth : {90.1, 90.5, 91.0, 91.3, 91.9}) EXPECT_NEAR(read(tap_at(kGrid, depth, kFloor), p), p(depth), 1e-9) << depth;
}

TEST(DepthTap, FollowsThePressureAroundTheKinkOfALayerInTheSediment) {
  const std::vector<Interface> layered{{91.0, 1.0, 1.5}, {120.7, 1.5, 2.1}};
  const auto p = [](double z) { return z <= 120.7 ? 1.0 + 0.05 * (z - 120.7) : 1.0 + 0.05 * 2.1 / 1.5 * (z - 120.7); };
  for (const double depth : {118.0, 120.3, 120.7, 121.2, 125.0})
    EXPECT_NEAR(read(tap_at(kGrid, depth, layered), p), p(depth), 1e-9) << depth;
}

}  // namespace
}  // namespace earshot::pe
