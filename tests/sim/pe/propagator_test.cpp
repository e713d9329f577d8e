#include "sim/pe/propagator.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <vector>

namespace earshot::pe {
namespace {

using Complex = std::complex<double>;
const Spectrum kDeepOcean{.lowest = -40.0, .trapped = -0.067, .highest = 0.0};

Propagator of_phase(double phase, std::size_t terms = 16) {
  return make_propagator(1.0, phase, std::vector<double>{0.3 * phase, phase}, kDeepOcean, terms);
}

TEST(Propagator, FollowsTheStepOverTrappedWavesToAMillionthAtSixteenPoles) {
  for (const double phase : {0.5, 2.0, 8.0, 16.0}) EXPECT_LT(of_phase(phase).largest_error, 1e-6) << phase;
  EXPECT_LT(of_phase(32.0).largest_error, 1e-5);
}

TEST(Propagator, GrowsNoWaveByMoreThanATenthOfAPercentAStep) {
  for (const double phase : {0.5, 2.0, 8.0, 16.0, 32.0}) EXPECT_LT(of_phase(phase).largest_modulus, 1.001) << phase;
}

TEST(Propagator, HasEveryPoleBelowTheRealAxisAndSoDampsEverythingAboveIt) {
  for (const double phase : {0.5, 2.0, 8.0, 32.0}) {
    for (const std::size_t terms : {8U, 12U, 16U}) {
      const Propagator propagator = of_phase(phase, terms);
      for (const Complex pole : propagator.step.pole) EXPECT_LT(pole.imag(), 0.0);
      for (double x = -5.0; x <= 0.0; x += 0.05) EXPECT_LE(std::abs(propagator.step(Complex(x, 0.1))), 1.0) << phase << ' ' << x;
    }
  }
}

TEST(Propagator, ReadsThePressureInsideTheStepOffTheSamePoles) {
  const Propagator propagator = of_phase(8.0);
  const Rational early{propagator.step.pole, propagator.pressure_residue[0]};
  for (double x = -0.9; x <= 0.0; x += 0.01) {
    const double root = std::sqrt(1.0 + x);
    const Complex exact = std::polar(1.0 / std::sqrt(root), 0.3 * 8.0 * (root - 1.0));
    EXPECT_LT(std::abs(early(x) - exact), 1e-3) << x;  // 0.01 dB, of waves steeper than 60 degrees
    if (x > -0.6) {
      EXPECT_LT(std::abs(early(x) - exact), 1e-4) << x;
    }
  }
}

}  // namespace
}  // namespace earshot::pe
