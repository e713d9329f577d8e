#include "policy/ppo/adam.hpp"

#include <gtest/gtest.h>

#include <array>

namespace earshot::ppo {
namespace {

TEST(Adam, TakesStepsWorkedOutByHand) {
  // g = 0.5 then -1, lr = 0.1.
  // t = 1: m = 0.05, v = 0.00025; corrected 0.5 and 0.25; p = 1 - 0.1 * 0.5 / (0.5 + 1e-5) = 0.900002.
  // t = 2: m = 0.045 - 0.1 = -0.055, v = 0.00024975 + 0.001 = 0.00124975; corrected -0.055 / 0.19 = -0.289473684 and
  //        0.00124975 / 0.001999 = 0.625187594, root 0.790688052; p = 0.900002 + 0.1 * 0.289473684 / 0.790698052 = 0.936611890.
  Adam adam(1);
  std::array<float, 1> p{1.0F};
  adam.step(p, std::array<float, 1>{0.5F}, 0.1);
  EXPECT_NEAR(p[0], 0.900002F, 2e-7F);  // float's spacing at 1 is 6e-8 to 1.2e-7
  adam.step(p, std::array<float, 1>{-1.0F}, 0.1);
  EXPECT_NEAR(p[0], 0.936611890F, 1e-7F);  // with epsilon under the root it would be 0.936612060
}

TEST(Adam, MovesByTheLearningRateWhateverTheSizeOfALargeGradient) {
  Adam adam(2);
  std::array<float, 2> p{0.0F, 0.0F};
  adam.step(p, std::array<float, 2>{1e3F, -1e6F}, 0.01);
  EXPECT_FLOAT_EQ(p[0], -0.01F);
  EXPECT_FLOAT_EQ(p[1], 0.01F);
}

TEST(ClipGradient, ScalesALongGradientToTheLimit) {
  std::array<float, 2> g{3.0F, 4.0F};
  EXPECT_DOUBLE_EQ(clip_gradient(g, 0.5), 5.0);
  EXPECT_FLOAT_EQ(g[0], 0.3F);  // 3 * 0.5 / (5 + 1e-6): within float's spacing of 0.3
  EXPECT_FLOAT_EQ(g[1], 0.4F);
}

TEST(ClipGradient, LeavesAShortGradientAlone) {
  std::array<float, 2> g{0.3F, -0.1F};
  clip_gradient(g, 0.5);
  EXPECT_EQ(g[0], 0.3F);
  EXPECT_EQ(g[1], -0.1F);
}

}  // namespace
}  // namespace earshot::ppo
