#include "sim/pe/rational/small_matrix.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <stdexcept>
#include <vector>

namespace earshot::pe {
namespace {

using Complex = std::complex<double>;
constexpr double kRounding = 1e-13;  // of matrices of three columns with elements near one

SmallMatrix matrix_of(const std::vector<std::vector<Complex>>& rows) {
  SmallMatrix result(rows.size(), rows.front().size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    for (std::size_t j = 0; j < rows[i].size(); ++j) result(i, j) = rows[i][j];
  }
  return result;
}

void expect_near(const std::vector<Complex>& actual, const std::vector<Complex>& expected, double tolerance) {
  ASSERT_EQ(actual.size(), expected.size());
  for (std::size_t i = 0; i < actual.size(); ++i) EXPECT_LT(std::abs(actual[i] - expected[i]), tolerance) << i;
}

TEST(PivotedQr, FitsALineThroughFourPointsAsByHand) {
  // 6, 5, 7, 10 at 1, 2, 3, 4: normal equations (4 10; 10 30) x = (28, 77), so x = (3.5, 1.4). Times i on the right: times i in x.
  const PivotedQr line(matrix_of({{1, 1}, {1, 2}, {1, 3}, {1, 4}}));
  const Complex i(0.0, 1.0);
  expect_near(line.least_squares(std::vector<Complex>{6.0 * i, 5.0 * i, 7.0 * i, 10.0 * i}), {3.5 * i, 1.4 * i}, kRounding);
}

TEST(PivotedQr, LeavesAColumnThatDependsOnAnotherAlone) {
  const std::vector<Complex> x = PivotedQr(matrix_of({{1, 2}, {1, 2}, {1, 2}})).least_squares(std::vector<Complex>{4, 4, 4});
  EXPECT_LT(std::abs(x[0] + 2.0 * x[1] - 4.0), kRounding);
  EXPECT_TRUE(x[0] == 0.0 || x[1] == 0.0);
}

TEST(PivotedQr, FindsTheLeastSingularVectorOfAMatrixWithKnownOnes) {
  // U diag(3, 0.5) V^H with V = (1 i; i 1) / sqrt 2: the least belongs to V's second column.
  const Complex i(0.0, 1.0);
  const std::vector<Complex> x = PivotedQr(matrix_of({{3, -3.0 * i}, {-0.5 * i, 0.5}, {0, 0}})).least_singular_vector(100);
  EXPECT_LT(std::abs(std::abs(x[0] * -i + x[1]) / std::sqrt(2.0) - 1.0), kRounding);
  EXPECT_LT(std::abs(x[0] - i * x[1]), kRounding);
}

TEST(PivotedQr, FindsTheNullVectorOfASingularMatrix) {
  const std::vector<Complex> x = PivotedQr(matrix_of({{1, 2, 3}, {4, 5, 6}, {7, 8, 9}})).least_singular_vector(100);
  EXPECT_LT(std::abs(x[0] + 0.5 * x[1]), kRounding);  // (1, -2, 1)
  EXPECT_LT(std::abs(x[2] + 0.5 * x[1]), kRounding);
}

TEST(Eigenvalues, AreTheZerosOfACompanionMatrixPolynomial) {
  // (x - 1)(x - 2)(x - i)(x + 3) = x^4 - i x^3 - 7 x^2 + (6 + 7 i) x - 6 i
  const Complex i(0.0, 1.0);
  std::vector<Complex> found = eigenvalues(matrix_of({{i, 7, -6.0 - 7.0 * i, 6.0 * i}, {1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}));
  std::ranges::sort(found, {}, [](Complex value) { return value.real(); });
  expect_near(found, {-3.0, i, 1.0, 2.0}, kRounding);
}

TEST(Eigenvalues, OfACyclicPermutationAreTheRootsOfOne) {  // the usual shift alone is 0 here, and goes round in circles
  std::vector<Complex> found = eigenvalues(matrix_of({{0, 0, 1}, {1, 0, 0}, {0, 1, 0}}));
  std::ranges::sort(found, {}, [](Complex value) { return value.imag(); });
  expect_near(found, {{-0.5, -std::sqrt(0.75)}, 1.0, {-0.5, std::sqrt(0.75)}}, kRounding);
}

// What is turned to zero has length one, as 0.6 and 0.8 have. On (0, -0.8, 0.6) it is twice the identity; on the other two, (1 1; 1 2).
TEST(Eigenvalues, OfAMatrixWhoseFirstColumnIsTurnedByLengthOne) {
  std::vector<Complex> found = eigenvalues(matrix_of({{1, 0.6, 0.8}, {0.6, 2, 0}, {0.8, 0, 2}}));
  std::ranges::sort(found, {}, [](Complex value) { return value.real(); });
  expect_near(found, {(3.0 - std::sqrt(5.0)) / 2.0, 2.0, (3.0 + std::sqrt(5.0)) / 2.0}, kRounding);
}

TEST(Eigenvalues, OfNoNumbersAreRefused) {
  EXPECT_THROW((void)eigenvalues(matrix_of({{std::numeric_limits<double>::quiet_NaN(), 1}, {1, 1}})), std::runtime_error);
}

}  // namespace
}  // namespace earshot::pe
