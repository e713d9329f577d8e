#include "sim/pe/water_samples.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <vector>

namespace earshot::pe {
namespace {

/// Sum over nodes of (1 / c^2 - 1 / 1500^2) z^power.
double moment(const std::vector<double>& speed_mps, double step_m, int power) {
  double sum = 0.0;
  for (std::size_t i = 0; i < speed_mps.size(); ++i)
    sum += step_m * (1.0 / (speed_mps[i] * speed_mps[i]) - 1.0 / (1500.0 * 1500.0)) * std::pow(static_cast<double>(i) * step_m, power);
  return sum;
}

TEST(WaterSamples, AreThoseOfASmoothProfile) {
  const ocean::MunkProfile munk{MetersPerSecond{1500.0}, Meters{1300.0}, Meters{1300.0}, 0.00737};
  const std::vector<double> samples = water_samples(munk, Meters{4.0}, 100);
  ASSERT_EQ(samples.size(), 101U);
  EXPECT_EQ(samples[75], ocean::sound_speed(munk, Meters{300.0}).value);
}

TEST(WaterSamples, AreThoseOfATableWhereItIsSmooth) {
  const ocean::TabulatedProfile table{{0.0, 200.0}, {1540.0, 1500.0}};
  EXPECT_NEAR(water_samples(table, Meters{4.0}, 40)[20], 1524.0, 1e-5);  // 80 m; 1 / c^2 of a straight line bends a little
}

TEST(WaterSamples, KeepAThinLayersStrengthAndPlaceWhereverTheNodesLie) {
  // A layer of 10 cm in 1500 m/s, slower by 100 m/s in its middle: no node of a 3 m grid need see it.
  for (const double middle : {60.0, 60.7, 61.5, 62.9}) {
    const ocean::TabulatedProfile table{{0.0, middle - 0.05, middle, middle + 0.05}, {1500.0, 1500.0, 1400.0, 1500.0}};
    const std::vector<double> samples = water_samples(table, Meters{3.0}, 60);
    // A triangle of 1 / c^2, but for its curvature: int = 2 x 0.05 m x mean of 1 / c^2 from 1400 to 1500, which is 1 / (1400 x 1500).
    const double strength = 0.1 * (1.0 / (1400.0 * 1500.0) - 1.0 / (1500.0 * 1500.0));
    EXPECT_NEAR(moment(samples, 3.0, 0) / strength, 1.0, 1e-4) << middle;
    EXPECT_NEAR(moment(samples, 3.0, 1) / strength, middle, 0.01) << middle;
  }
}

}  // namespace
}  // namespace earshot::pe
