#include "sim/pe/rational.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <complex>
#include <stdexcept>

namespace earshot::pe {
namespace {

using Complex = std::complex<double>;

/// exp(i phase (sqrt(1 + x) - 1)) by the library's own square root and exponential.
Complex step(double x, double phase) {
  return std::exp(Complex(0.0, phase) * (std::sqrt(Complex(1.0 + x, 0.0)) - 1.0));
}

TEST(Rational, PadeOfTheExponentialIsTheTextbookOne) {
  // [2/2] of exp(x) is (1 + x/2 + x^2/12) / (1 - x/2 + x^2/12): 19/7 at x = 1 (Baker & Graves-Morris, table 1.1).
  const std::array<Wide, 5> taylor = {1.0L, 1.0L, 1.0L / 2.0L, 1.0L / 6.0L, 1.0L / 24.0L};
  const Rational fit = pade(taylor, 2);
  EXPECT_NEAR(fit(1.0).real(), 19.0 / 7.0, 1e-13);  // rounding of two residues of order 10
  EXPECT_NEAR(fit(1.0).imag(), 0.0, 1e-13);
}

TEST(Rational, TaylorSeriesOfTheStepIsTheHandMadeOne) {
  // With s = sqrt(1 + x) - 1 = x/2 - x^2/8 + ...: exp(i d s) = 1 + i d x/2 + (-d^2/8 - i d/8) x^2 + ...; d = 2.
  const auto series = taylor_of_step(2.0L, 3);
  EXPECT_EQ(series[0], Wide(1.0L, 0.0L));
  EXPECT_EQ(series[1], Wide(0.0L, 1.0L));
  EXPECT_EQ(series[2], Wide(-0.5L, -0.25L));
}

TEST(Rational, StepFollowsTheSquareRootOverThePropagatingSpectrum) {
  const double phase = 2.0 * M_PI * 20.0 / 1500.0 * 50.0;  // 50 m at 20 Hz
  const Rational fit = propagator(phase, 8);
  for (double x = -0.8; x <= 0.1; x += 0.01)
    EXPECT_LT(std::abs(fit(x) - step(x, phase)), 1e-5) << x;  // 1e-5 a step is 0.04 dB in 500 steps
}

TEST(Rational, StepHasModulusOneOnTheRealAxisAndLessAboveIt) {
  for (const double phase : {0.5, 1.7, 4.2, 8.4}) {
    const Rational fit = propagator(phase, 8);
    for (double x = -200.0; x <= 0.2; x += 0.1) {
      EXPECT_NEAR(std::abs(fit(x)), 1.0, 1e-9) << phase << ' ' << x;  // 1e-9 a step stays below 0.001 dB in 1e5 steps
      EXPECT_LT(std::abs(fit(Complex(x, 0.01))), 1.0) << phase << ' ' << x;
    }
  }
}

TEST(Rational, RefusesMorePolesThanItsArithmeticCanFind) {
  EXPECT_THROW((void)propagator(0.5, 40), std::runtime_error);
}

}  // namespace
}  // namespace earshot::pe
