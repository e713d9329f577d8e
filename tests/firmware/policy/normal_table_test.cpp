#include "firmware/policy/normal_table.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace earshot::policy {
namespace {

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

TEST(NormalCumulative, HoldsFarOutWhereTheTableEnds) {
  EXPECT_LT(normal_cumulative(-1000.0F), 1e-6F);
  EXPECT_GT(normal_cumulative(1000.0F), 1.0F - 1e-6F);
}

}  // namespace
}  // namespace earshot::policy
