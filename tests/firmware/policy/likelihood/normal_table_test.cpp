#include "firmware/policy/likelihood/normal_table.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <span>
#include <vector>

namespace earshot::policy {
namespace {

float normal_density(float x) {
  to_normal_density(std::span(&x, 1));
  return x;
}

float normal_cumulative(float x) {
  to_normal_cumulative(std::span(&x, 1));
  return x;
}

constexpr double kTolerance = 5e-5;  // linear between entries 1/32 apart: at most 1/8 (1/32)^2 of the second derivative, 0.4

TEST(NormalDensity, IsThatOfTheClosedForm) {
  for (double x = -9.0; x <= 9.0; x += 0.013) {
    const double expected = std::exp(-0.5 * x * x) / std::sqrt(2.0 * std::numbers::pi);
    EXPECT_NEAR(double{normal_density(static_cast<float>(x))}, expected, kTolerance) << x;
  }
}

TEST(NormalCumulative, IsThatOfTheClosedForm) {
  for (double x = -9.0; x <= 9.0; x += 0.013) {
    EXPECT_NEAR(double{normal_cumulative(static_cast<float>(x))}, 0.5 * std::erfc(-x / std::numbers::sqrt2), kTolerance) << x;
  }
}

TEST(NormalTable, TakesManyNumbersAsItTakesEach) {
  std::vector<float> numbers;
  for (int i = -40; i < 41; ++i) numbers.push_back(0.23F * static_cast<float>(i));
  std::vector<float> densities = numbers;
  std::vector<float> probabilities = numbers;
  to_normal_density(densities);
  to_normal_cumulative(probabilities);
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    EXPECT_EQ(densities[i], normal_density(numbers[i]));
    EXPECT_EQ(probabilities[i], normal_cumulative(numbers[i]));
  }
}

TEST(NormalCumulative, HoldsFarOutWhereTheTableEnds) {
  EXPECT_LT(normal_cumulative(-1000.0F), 1e-6F);
  EXPECT_GT(normal_cumulative(1000.0F), 1.0F - 1e-6F);
}

}  // namespace
}  // namespace earshot::policy
