#include "sim/pe/sweep.hpp"
#include "tests/sim/pe/short_section.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <complex>

namespace earshot::pe {
namespace {

using Complex = std::complex<double>;

const ocean::Section kSlope =
    tests::section_of({.floor = {{0.0, 60.0}, {1'000.0, 40.0}},
                       .water = {{0.0, ocean::TabulatedProfile{{0.0}, {1500.0}}}},
                       .sediment = {{0.0, {{0.0, 1600.0, 1.5, 0.5}, {10.0, 1650.0, 1.6, 0.5}, {10.0, 1800.0, 2.0, 0.5}}}}});
constexpr Hertz kFrequency{100.0};

Eigen::MatrixXcd dense(const Tridiagonal& t) {
  const auto n = static_cast<Eigen::Index>(t.diagonal.size()) - 2;
  Eigen::MatrixXcd matrix = Eigen::MatrixXcd::Zero(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    matrix(i, i) = t.diagonal[static_cast<std::size_t>(i + 1)];
    if (i + 1 < n) matrix(i, i + 1) = matrix(i + 1, i) = t.off[static_cast<std::size_t>(i + 1)];
  }
  return matrix;
}

Rational some_rational(std::size_t terms) {
  Rational r;
  for (std::size_t j = 0; j < terms; ++j) {
    const auto t = static_cast<double>(j);
    r.pole.emplace_back(-1.0 + 0.3 * t, -0.2 - 0.05 * t);
    r.residue.emplace_back(0.1 + 0.02 * t, 0.3 - 0.04 * t);
  }
  return r;
}

Eigen::VectorXcd applied(const Rational& r, const DepthOperator& op, const Eigen::VectorXcd& right) {
  Eigen::VectorXcd sum = Eigen::VectorXcd::Zero(right.size());
  for (std::size_t j = 0; j < r.pole.size(); ++j)
    sum += r.residue[j] * (dense(op.mass()) - dense(op.g()) / r.pole[j]).partialPivLu().solve(right);
  return sum;
}

Eigen::VectorXcd field_of(const Sweep& sweep, Eigen::Index rows) {
  Eigen::VectorXcd field(rows);
  for (Eigen::Index i = 0; i < rows; ++i) field(i) = sweep.field(static_cast<std::size_t>(i + 1));
  return field;
}

class SweepOfTerms : public testing::TestWithParam<std::size_t> {};

TEST_P(SweepOfTerms, SolvesWhatADenseEliminationSolves) {
  const DepthGrid grid = make_depth_grid(kSlope, kFrequency, Meters{1.0}, choose_absorber(kSlope, kFrequency, Meters{1'000.0}, {}));
  DepthOperator op(kSlope, kFrequency, grid);
  const Rational r = some_rational(GetParam());
  Sweep sweep(grid.intervals, GetParam());
  sweep.set_rational(r);
  sweep.take(op, {1, grid.intervals - 1}, 59);
  for (std::size_t i = 1; i < grid.intervals; ++i) sweep.set_field(i, std::polar(1.0, 0.37 * static_cast<double>(i)));
  const auto n = static_cast<Eigen::Index>(grid.intervals) - 1;

  const Eigen::VectorXcd first = applied(r, op, dense(op.mass()) * field_of(sweep, n));
  sweep.apply();
  EXPECT_LT((field_of(sweep, n) - first).norm(), 1e-11 * first.norm());  // rounding, times the condition of a few hundred rows

  // The sea floor rises by 7 m: only part of the factors is computed anew, and the right-hand side is the mean of both media.
  const Eigen::MatrixXcd before = dense(op.mass());
  const RowRange changed = op.rows_changed_by(350.0);
  EXPECT_GT(changed.first, 40U);
  op.move_to(350.0);
  sweep.take(op, changed, 52);
  const Eigen::VectorXcd second = applied(r, op, 0.5 * (before + dense(op.mass())) * field_of(sweep, n));
  sweep.apply();
  EXPECT_LT((field_of(sweep, n) - second).norm(), 1e-11 * second.norm());

  // And back down, from where nothing is averaged any more.
  op.move_to(350.0);
  const Eigen::VectorXcd third = applied(r, op, dense(op.mass()) * field_of(sweep, n));
  sweep.apply();
  EXPECT_LT((field_of(sweep, n) - third).norm(), 1e-11 * third.norm());
}

INSTANTIATE_TEST_SUITE_P(Sweep, SweepOfTerms, testing::Values(2, 4, 5, 7, 8, 9, 12, 16));

}  // namespace
}  // namespace earshot::pe
