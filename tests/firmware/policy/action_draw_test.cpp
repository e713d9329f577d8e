#include "firmware/policy/action_draw.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

namespace earshot::policy {
namespace {

TEST(DrawAction, ArgmaxTakesTheFirstOfEqualsAndNoRandomNumber) {
  Pcg32 random(1);
  Pcg32 untouched(1);
  EXPECT_EQ(draw_action(ActionDraw::kArgmax, std::array{-1.0F, 2.0F, 2.0F, 0.0F}, random), 1U);
  EXPECT_EQ(random.next(), untouched.next());
}

TEST(DrawAction, SampledTakesExactlyOneRandomNumber) {
  Pcg32 random(1);
  Pcg32 once(1);
  static_cast<void>(draw_action(ActionDraw::kSampled, std::array{0.0F, 0.0F}, random));
  static_cast<void>(once.next());
  EXPECT_EQ(random.next(), once.next());
}

TEST(DrawAction, SampledDrawsAsOftenAsTheSoftmaxSays) {
  const std::array logits = {0.0F, std::log(2.0F), std::log(5.0F)};  // probabilities 1/8, 2/8, 5/8
  constexpr int kDraws = 80000;
  std::array<int, 3> drawn{};
  Pcg32 random(5);
  for (int i = 0; i < kDraws; ++i) ++drawn[draw_action(ActionDraw::kSampled, logits, random)];
  EXPECT_NEAR(drawn[0], 10000, 470);  // five standard deviations, sqrt(n p (1 - p))
  EXPECT_NEAR(drawn[1], 20000, 615);
  EXPECT_NEAR(drawn[2], 50000, 685);
}

TEST(DrawAction, NeverDrawsAnActionOfNoProbability) {
  const std::array logits = {-200.0F, 0.0F, -200.0F};
  Pcg32 random(9);
  for (int i = 0; i < 10000; ++i) ASSERT_EQ(draw_action(ActionDraw::kSampled, logits, random), 1U);
}

TEST(DrawAction, NeverDrawsAnActionOfNoProbabilityThoughTheRandomNumberIsZero) {
  Pcg32 random(Pcg32::State{.state = 0, .increment = 1});  // the next number is that of the state zero: zero
  EXPECT_EQ(Pcg32(random.state()).uniform_float(), 0.0F);
  EXPECT_EQ(draw_action(ActionDraw::kSampled, std::array{-200.0F, 0.0F}, random), 1U);
}

TEST(DrawAction, StaysWithinTheActionsWhenLogitsAreNotNumbers) {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  Pcg32 random(1);
  EXPECT_LT(draw_action(ActionDraw::kSampled, std::array{kNan, kNan}, random), 2U);
  EXPECT_LT(draw_action(ActionDraw::kArgmax, std::array{kNan, kNan}, random), 2U);
}

TEST(Softmax, DoesNotOverflowForHugeLogits) {
  std::array<float, 2> probabilities{};
  softmax(std::array{1000.0F, 1000.0F}, probabilities);
  EXPECT_EQ(probabilities, (std::array{0.5F, 0.5F}));
}

TEST(Softmax, OfLogarithmsGivesTheirShares) {
  std::array<float, 3> probabilities{};
  softmax(std::array{0.0F, std::log(2.0F), std::log(5.0F)}, probabilities);
  EXPECT_NEAR(probabilities[0], 0.125F, 1e-7F);  // a few roundings of floats below one
  EXPECT_NEAR(probabilities[1], 0.25F, 1e-7F);
  EXPECT_NEAR(probabilities[2], 0.625F, 1e-7F);
}

}  // namespace
}  // namespace earshot::policy
