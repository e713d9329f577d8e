#include "sim/pe/aaa.hpp"

#include <gtest/gtest.h>

#include <complex>

namespace earshot::pe {
namespace {

using Complex = std::complex<double>;

/// Two poles, at -2 - i and 0.3 - 0.5 i.
Complex known(Complex x) {
  return 0.25 + Complex(1.0, 2.0) / (x - Complex(-2.0, -1.0)) + 3.0 / (x - Complex(0.3, -0.5));
}

TEST(Aaa, RecoversARationalFunctionFromItsSamples) {
  Samples samples;
  for (int i = 0; i < 50; ++i) {
    samples.x.push_back(-3.0 + 0.1 * i);
    samples.value.push_back(known(samples.x.back()));
    samples.weight.push_back(1.0);
  }
  const Rational fit = fit_rational(samples, 2);
  const Complex outside(4.0, 1.0);
  EXPECT_LT(std::abs(fit(outside) - known(outside)), 1e-11);  // rounding times a condition number of some hundred
  EXPECT_LT(weighted_error(fit, samples), 1e-12);
}

TEST(Aaa, WeighsItsErrorAsTold) {
  Samples samples;
  samples.x = {0.0};
  samples.value = {2.0};
  samples.weight = {0.5};
  EXPECT_DOUBLE_EQ(weighted_error(Rational{Complex(1.0), {}, {}}, samples), 0.5);
}

}  // namespace
}  // namespace earshot::pe
