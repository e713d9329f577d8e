#include "sim/pe/depth_grid.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace earshot::pe {
namespace {

const ocean::SoundSpeedProfile kUniformWater = ocean::TabulatedProfile{{0.0}, {1500.0}};

ocean::Seabed mud_over_rock(double depth_m) {
  return {.depth = Meters{depth_m},
          .layers = {
              {.thickness = Meters{33.0},
               .sound_speed = MetersPerSecond{1550.0},
               .density_g_per_cm3 = 1.4,
               .attenuation_db_per_wavelength = 0.1},
              {.thickness = {}, .sound_speed = MetersPerSecond{2000.0}, .density_g_per_cm3 = 2.2, .attenuation_db_per_wavelength = 0.5}}};
}

DepthGrid grid_of(double depth_m, double step_m) {
  return make_depth_grid(kUniformWater, mud_over_rock(depth_m), Hertz{50.0}, {.step = Meters{step_m}, .absorber_wavelengths = 6.0});
}

double value_at(const DepthTap& tap, double step_m, double (*f)(double)) {
  double sum = 0.0;
  for (std::size_t i = 0; i < tap.weight.size(); ++i) sum += tap.weight[i] * f(step_m * static_cast<double>(tap.first_node + i));
  return sum;
}

TEST(DepthGrid, PutsTheSeaFloorAndEveryInterfaceOnANode) {
  const DepthGrid grid = grid_of(101.0, 5.0);
  EXPECT_EQ(grid.sea_floor_node, 21U);  // 101 m in elements of at most 5 m
  EXPECT_DOUBLE_EQ(grid.water_step_m * 21.0, 101.0);
  double depth_m = 0.0;
  for (const Element& element : grid.elements) {
    if (element.medium < 2) depth_m += element.length_m.real();
  }
  EXPECT_NEAR(depth_m, 134.0, 1e-9);  // rounding of 28 sums
}

TEST(DepthGrid, LosesTheStatedDecibelsInOneWavelength) {
  // Over one wavelength, 2 pi / Re k, the amplitude falls by exp(-2 pi Im k / Re k): 0.1 dB.
  const DepthGrid grid = grid_of(100.0, 5.0);
  const std::complex<double> k = std::sqrt(grid.elements[grid.sea_floor_node].squared_wavenumber_top);
  EXPECT_NEAR(20.0 * std::log10(std::exp(2.0 * M_PI * k.imag() / k.real())), 0.1, 1e-9);
}

TEST(DepthGrid, StretchesOnlyItsAbsorberIntoTheComplexPlane) {
  const DepthGrid grid = grid_of(100.0, 5.0);
  for (const Element& element : grid.elements) EXPECT_EQ(element.length_m.imag() > 0.0, element.medium == 2);
}

TEST(DepthTap, IsExactForACubicBelowTheSurface) {
  const DepthGrid grid = grid_of(100.0, 5.0);
  const auto cubic = [](double z) { return 1.0 + z * (0.5 - z * (0.02 - 0.0003 * z)); };
  for (const double depth_m : {5.0, 36.0, 47.3, 99.0, 100.0}) {
    EXPECT_NEAR(value_at(tap_at(grid, Meters{depth_m}), 5.0, cubic), cubic(depth_m), 1e-9) << depth_m;  // rounding of values of order 100
  }
}

TEST(DepthTap, IsExactForAnOddCubicAtTheSurface) {
  const DepthGrid grid = grid_of(100.0, 5.0);
  const auto odd = [](double z) { return z * (2.0 + 0.01 * z * z); };
  for (const double depth_m : {0.0, 1.0, 4.9})
    EXPECT_NEAR(value_at(tap_at(grid, Meters{depth_m}), 5.0, odd), odd(depth_m), 1e-12) << depth_m;
}

TEST(DepthTap, DoesNotReachBelowTheSeaFloor) {
  const DepthGrid grid = grid_of(100.0, 5.0);
  EXPECT_LE(tap_at(grid, Meters{100.0}).first_node + 3, grid.sea_floor_node);
}

}  // namespace
}  // namespace earshot::pe
