#include "policy/ppo/small_product.hpp"

#include <gtest/gtest.h>

#include "firmware/core/random.hpp"

namespace earshot::ppo {
namespace {

using Matrix = Eigen::MatrixXd;

Matrix random_matrix(Eigen::Index rows, Eigen::Index columns, Pcg32& random) {
  return Matrix::NullaryExpr(rows, columns, [&random] { return 2.0 * random.uniform_double() - 1.0; });
}

constexpr double kRounding = 1e-13;  // 64-term sums of order one in double, in another order

TEST(SmallProduct, AddsWhatEigensProductGivesForEveryNumberOfColumns) {
  Pcg32 random(1);
  for (Eigen::Index columns = 0; columns <= 9; ++columns) {
    const Matrix a = random_matrix(128, 7, random);
    const Matrix b = random_matrix(7, columns, random);
    Matrix c = random_matrix(128, columns, random);
    const Matrix expected = c + a * b;
    add_product<double>(128, columns, 7, {a.data(), 128}, {b.data(), 1, 7}, {c.data(), 128});
    EXPECT_TRUE(columns == 0 || (c - expected).cwiseAbs().maxCoeff() < kRounding) << columns;
  }
}

TEST(SmallProduct, TakesItsRightFactorTransposedAndItsOthersFromTallerMatrices) {
  Pcg32 random(2);
  const Matrix a = random_matrix(128, 64, random);
  const Matrix b = random_matrix(10, 64, random);
  Matrix c = Matrix::Zero(128, 10);
  add_product<double>(64, 10, 64, {a.data() + 64, 128}, {b.data(), 10, 1}, {c.data() + 64, 128});
  EXPECT_LT((c.bottomRows(64) - a.bottomRows(64) * b.transpose()).cwiseAbs().maxCoeff(), kRounding);
  EXPECT_EQ(c.topRows(64).cwiseAbs().maxCoeff(), 0.0);
}

}  // namespace
}  // namespace earshot::ppo
