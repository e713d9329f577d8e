#include "policy/ppo/orthogonal.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace earshot::ppo {
namespace {

constexpr double kRounding = 1e-12;  // 64-term sums in double: some 1e-15 each

TEST(Orthogonal, HasOrthonormalColumnsTimesTheGainWhenTall) {
  Pcg32 random(1);
  const Eigen::MatrixXd w = orthogonal(64, 6, std::sqrt(2.0), random);
  EXPECT_LT((w.transpose() * w - 2.0 * Eigen::MatrixXd::Identity(6, 6)).cwiseAbs().maxCoeff(), kRounding);
}

TEST(Orthogonal, HasOrthonormalRowsTimesTheGainWhenWide) {
  Pcg32 random(1);
  const Eigen::MatrixXd w = orthogonal(8, 64, 0.01, random);
  EXPECT_LT((w * w.transpose() - 1e-4 * Eigen::MatrixXd::Identity(8, 8)).cwiseAbs().maxCoeff(), kRounding);
}

TEST(Orthogonal, FavoursNoSignOnItsDiagonal) {
  // Without the signs of R, Householder QR gives first columns of one sign only. 400 draws: 200 expected, standard deviation 10.
  Pcg32 random(5);
  int positive = 0;
  for (int i = 0; i < 400; ++i) positive += orthogonal(3, 3, 1.0, random)(0, 0) > 0.0 ? 1 : 0;
  EXPECT_NEAR(positive, 200, 50);
}

TEST(StandardNormal, HasMeanZeroVarianceOneAndANormalsTails) {
  Pcg32 random(3);
  constexpr int kDraws = 100'000;
  double sum = 0.0;
  double squares = 0.0;
  int beyond_two = 0;
  for (int i = 0; i < kDraws; ++i) {
    const double x = standard_normal(random);
    sum += x;
    squares += x * x;
    beyond_two += std::abs(x) > 2.0 ? 1 : 0;
  }
  EXPECT_NEAR(sum / kDraws, 0.0, 0.016);                                  // five standard errors of 1/sqrt(n)
  EXPECT_NEAR(squares / kDraws, 1.0, 0.023);                              // five of sqrt(2/n)
  EXPECT_NEAR(static_cast<double>(beyond_two) / kDraws, 0.0455, 0.0033);  // five of sqrt(p(1-p)/n); tables give p = 0.0455
}

}  // namespace
}  // namespace earshot::ppo
