#include "firmware/detector/hydrophone/chi_square.hpp"

#include <gtest/gtest.h>

namespace earshot::detector {
namespace {

// Values: scipy 1.10.1, scipy.stats.chi2.ppf(scipy.stats.norm.cdf(z), n) / n.
TEST(ChiSquare, HasTheQuantilesThatScipyHas) {
  const double tolerance = 0.007;  // what the docstring says
  EXPECT_NEAR(chi_square_over_mean(10, 0.0), 0.9341817765591969, tolerance * 0.934);
  EXPECT_NEAR(chi_square_over_mean(10, -0.6745), 0.6737165515026479, tolerance * 0.674);
  EXPECT_NEAR(chi_square_over_mean(10, 3.0902323), 2.9588298389703063, tolerance * 2.959);
  EXPECT_NEAR(chi_square_over_mean(30, 0.0), 0.9778677172220528, tolerance * 0.978);
  EXPECT_NEAR(chi_square_over_mean(30, 3.0902323), 1.9901021409891213, tolerance * 1.990);
  EXPECT_NEAR(chi_square_over_mean(100, 3.0902323), 1.4944925266546172, tolerance * 1.494);
}

}  // namespace
}  // namespace earshot::detector
