#include "sim/pe/rational/rational.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <vector>

namespace earshot::pe {
namespace {

using Complex = std::complex<double>;

TEST(Rational, RecoversAFunctionWithThreePolesFromItsSamples) {
  const Rational truth{{{-2.0, -1.0}, {0.5, -3.0}, {4.0, -0.5}}, {{1.0, 0.0}, {0.0, 2.0}, {-1.0, 1.0}}};
  Samples samples;
  for (double x = -1.0; x <= 1.0; x += 0.05) samples.x.push_back(x), samples.value.push_back(truth(x)), samples.weight.push_back(1.0);
  std::vector<Complex> pole = fit_poles(samples, 3);
  std::sort(pole.begin(), pole.end(), [](Complex a, Complex b) { return a.real() < b.real(); });
  for (std::size_t j = 0; j < 3; ++j) EXPECT_LT(std::abs(pole[j] - truth.pole[j]), 1e-7) << j;  // conditioning of the companion matrix
  const Rational fitted{pole, ResidueFit(samples.x, samples.weight, pole).residues(samples.value)};
  for (std::size_t i = 0; i < samples.x.size(); ++i) EXPECT_LT(std::abs(fitted(samples.x[i]) - samples.value[i]), 1e-9);
}

}  // namespace
}  // namespace earshot::pe
