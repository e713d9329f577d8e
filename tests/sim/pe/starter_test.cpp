#include "sim/pe/starter.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>

namespace earshot::pe {
namespace {

using Complex = std::complex<double>;

struct Case {
  double phase;
  Spectrum spectrum;
};

class Starter : public testing::TestWithParam<Case> {};

TEST_P(Starter, FollowsItsFunctionOverTheWholeSpectrum) {
  const auto [phase, spectrum] = GetParam();
  const Rational fit = starter(phase, spectrum);
  // Propagating waves to 84 degrees: (1 + x)^(-1/4) exp(i phase (sqrt(1 + x) - 1)) with modulus (1 + x)^(-1/4).
  for (double x = -0.99; x <= spectrum.highest; x += 0.01) {
    const double root = std::sqrt(1.0 + x);
    const Complex exact = std::polar(1.0 / std::sqrt(root), phase * (root - 1.0));
    EXPECT_LT(std::abs(fit(x) - exact), x < -0.5 ? 1e-3 : 2e-5) << x;  // the fit's own goal is 1e-5 over its weight
  }
  // Evanescent waves decay as exp(-phase sqrt(-1 - x)), times (-1 - x)^(-1/4).
  for (double x = -2.0; x >= spectrum.lowest; x *= 1.1) {
    const double root = std::sqrt(-1.0 - x);
    EXPECT_NEAR(std::abs(fit(x)), std::exp(-phase * root) / std::sqrt(root), 2e-5) << x;
  }
}

INSTANTIATE_TEST_SUITE_P(FromNearToFarAndFineToCoarse, Starter,
                         testing::Values(Case{0.4, {-60.0, 0.02}}, Case{1.6, {-60.0, 0.02}}, Case{4.2, {-10.0, 0.2}},
                                         Case{4.2, {-3000.0, 0.02}}, Case{12.0, {-300.0, 0.1}}));

}  // namespace
}  // namespace earshot::pe
