#include "sim/pe/rational_operator.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <complex>
#include <vector>

namespace earshot::pe {
namespace {

using Complex = std::complex<double>;
using Eigen::Index;

Eigen::MatrixXcd dense(const Tridiagonal& t) {
  const auto n = static_cast<Index>(t.diagonal.size());
  Eigen::MatrixXcd matrix = Eigen::MatrixXcd::Zero(n, n);
  for (Index i = 0; i < n; ++i) {
    const auto row = static_cast<std::size_t>(i);
    matrix(i, i) = t.diagonal[row];
    if (i > 0) matrix(i, i - 1) = t.lower[row];
    if (i + 1 < n) matrix(i, i + 1) = t.upper[row];
  }
  return matrix;
}

DepthOperator shallow_water() {
  const ocean::Seabed seabed{
      .depth = Meters{40.0},
      .layers = {
          {.thickness = {}, .sound_speed = MetersPerSecond{1700.0}, .density_g_per_cm3 = 1.5, .attenuation_db_per_wavelength = 0.5}}};
  const DepthGrid grid = make_depth_grid(ocean::TabulatedProfile{{0.0, 40.0}, {1520.0, 1490.0}}, seabed, Hertz{100.0},
                                         {.step = Meters{2.0}, .absorber_wavelengths = 2.0});
  return make_depth_operator(grid, 2.0 * M_PI * 100.0 / 1500.0);
}

class RationalOperatorOf : public testing::TestWithParam<std::size_t> {};

TEST_P(RationalOperatorOf, SolvesWhatAnEliminationInEigenSolves) {
  const DepthOperator x = shallow_water();
  const Rational rational = propagator(2.0, GetParam());
  const auto n = static_cast<Index>(x.size());
  Eigen::VectorXcd before(n);
  for (Index i = 0; i < n; ++i) before[i] = Complex(std::sin(0.3 * static_cast<double>(i)), std::cos(1.0 + 0.7 * static_cast<double>(i)));

  const Eigen::MatrixXcd mass = dense(x.mass);
  Eigen::VectorXcd expected = rational.constant * before;
  for (std::size_t j = 0; j < rational.pole.size(); ++j) {
    expected += rational.residue[j] * (mass + rational.pole[j] * dense(x.g)).fullPivLu().solve(mass * before);
  }
  std::vector<Complex> p(before.begin(), before.end());
  RationalOperator(x, rational).apply(p);
  for (Index i = 0; i < n; ++i)
    EXPECT_LT(std::abs(p[static_cast<std::size_t>(i)] - expected[i]), 1e-10) << i;  // rounding times residues of order 20
}

INSTANTIATE_TEST_SUITE_P(LessThanAGroupOfLanesToMoreThanOne, RationalOperatorOf, testing::Values(1, 3, 8, 11));

}  // namespace
}  // namespace earshot::pe
