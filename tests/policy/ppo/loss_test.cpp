#include "policy/ppo/loss.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

namespace earshot::ppo {
namespace {

constexpr double kFewRoundings = 1e-12;  // a handful of double operations

TEST(NormaliseAdvantages, DividesByTheStandardDeviationWithOneDegreeOfFreedomLess) {
  // Mean 2, sum of squares 2, n - 1 = 2: standard deviation 1 (with n it would be 0.816).
  std::array<double, 3> a{1.0, 2.0, 3.0};
  normalise(std::span<double>(a));
  EXPECT_NEAR(a[0], -1.0, 2e-8);  // the 1e-8 added to the deviation
  EXPECT_NEAR(a[1], 0.0, kFewRoundings);
  EXPECT_NEAR(a[2], 1.0, 2e-8);
}

TEST(NormaliseAdvantages, LeavesASingleSampleAlone) {
  std::array<double, 1> a{7.0};
  normalise(std::span<double>(a));
  EXPECT_EQ(a[0], 7.0);
}

/// One sample, two actions with equal logits: pi = 1/2 each.
struct OneSample {
  std::uint8_t action = 0;
  double old_probability = 0.5;
  double advantage = 1.0;
  double ret = 0.0;
  double value = 0.0;
  HyperParameters hyper;
  Matrix<double> d_logits{2, 1};
  Matrix<double> d_values{1, 1};

  double loss() { return terms().total; }

  LossTerms<double> terms() {
    Matrix<double> logits = Matrix<double>::Zero(2, 1);
    const Matrix<double> values = Matrix<double>::Constant(1, 1, value);
    const std::array<std::uint8_t, 1> actions{action};
    const std::array<double, 1> old{std::log(old_probability)};
    std::array<double, 1> advantages{advantage};
    const std::array<double, 1> returns{ret};
    return ppo_loss<double>({actions, old, advantages, returns, actions.size()}, hyper, logits, values, d_logits, d_values);
  }
};

TEST(Loss, OfAnUnchangedPolicyIsMinusTheAdvantage) {
  OneSample one;
  one.advantage = 3.0;
  EXPECT_NEAR(one.loss(), -3.0, kFewRoundings);
  EXPECT_NEAR(one.d_logits(0, 0), -3.0 * 0.5, kFewRoundings);  // -A (1 - pi)
  EXPECT_NEAR(one.d_logits(1, 0), 3.0 * 0.5, kFewRoundings);   // A pi
}

TEST(Loss, StopsPushingAGoodActionBeyondTheClipRange) {
  OneSample one;
  one.old_probability = 0.25;
  one.advantage = 3.0;  // ratio 2, clipped to 1.2
  EXPECT_NEAR(one.loss(), -3.6, kFewRoundings);
  EXPECT_EQ(one.d_logits(0, 0), 0.0);
}

TEST(Loss, StillPullsBackABadActionThatBecameLikelier) {
  OneSample one;
  one.old_probability = 0.25;
  one.advantage = -3.0;  // ratio 2: min(-6, -3.6)
  EXPECT_NEAR(one.loss(), 6.0, kFewRoundings);
  EXPECT_NEAR(one.d_logits(0, 0), 3.0 * 2.0 * 0.5, kFewRoundings);
}

TEST(Loss, StopsPushingABadActionBeyondTheClipRange) {
  OneSample one;
  one.old_probability = 1.0;
  one.advantage = -3.0;  // ratio 0.5, clipped to 0.8: min(-1.5, -2.4)
  EXPECT_NEAR(one.loss(), 2.4, kFewRoundings);
  EXPECT_EQ(one.d_logits(0, 0), 0.0);
}

TEST(Loss, AddsHalfTheSquaredErrorOfTheValue) {
  OneSample one;
  one.advantage = 0.0;
  one.ret = 5.0;
  one.value = 2.0;
  EXPECT_NEAR(one.loss(), 0.5 * 9.0, kFewRoundings);
  EXPECT_NEAR(one.d_values(0, 0), -3.0, kFewRoundings);
}

TEST(Loss, SaysHowFarThePolicyHasMoved) {
  OneSample one;
  one.old_probability = 0.25;  // ratio 2
  EXPECT_NEAR(one.terms().approximate_kl, 2.0 - 1.0 - std::log(2.0), kFewRoundings);
  EXPECT_EQ(one.terms().clip_fraction, 1.0);
  one.old_probability = 0.45;  // ratio 1.11
  EXPECT_EQ(one.terms().clip_fraction, 0.0);
  EXPECT_NEAR(one.terms().entropy, std::log(2.0), kFewRoundings);
  one.ret = 5.0;
  one.value = 2.0;
  EXPECT_NEAR(one.terms().value, 9.0, kFewRoundings);
}

TEST(Loss, PaysForEntropyByItsCoefficient) {
  OneSample one;
  one.advantage = 0.0;
  one.hyper.entropy_coefficient = 0.1;
  EXPECT_NEAR(one.loss(), -0.1 * std::log(2.0), kFewRoundings);
  EXPECT_NEAR(one.d_logits(0, 0), 0.0, kFewRoundings) << "entropy is at its maximum";
}

}  // namespace
}  // namespace earshot::ppo
