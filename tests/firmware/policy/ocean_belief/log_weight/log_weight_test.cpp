#include "firmware/policy/ocean_belief/log_weight/log_weight.hpp"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <limits>

namespace earshot::policy {
namespace {

constexpr int kMost = 60'000;

TEST(LogWeight, BecomesAPowerOfTwoToAHundredthOfAPercentOverAllItsRange) {
  for (int w = -kMost; w <= kMost; ++w) ASSERT_NEAR(double{from_log(w)} / std::exp2(w / 512.0), 1.0, 8e-5) << w;
}

TEST(LogWeight, IsTheLogarithmToALittleMoreThanItsRounding) {
  for (std::uint32_t exponent = 1; exponent <= 254; ++exponent) {
    for (std::uint32_t m = 0; m < (1U << 23U); m += exponent == 126 ? 7 : 4'099) {
      const auto x = std::bit_cast<float>((exponent << 23U) | m);
      ASSERT_NEAR(to_log(x), 512.0 * std::log2(double{x}), 0.55) << x;
    }
  }
}

TEST(LogWeight, KnowsPowersOfTwoExactly) {
  for (int power = -126; power <= 127; ++power) EXPECT_EQ(to_log(std::ldexp(1.0F, power)), 512 * power);
}

TEST(LogWeight, ComesBackFromItsProbabilityWithinOneUnit) {
  for (int w = -kMost; w <= kMost; ++w) ASSERT_LE(std::abs(to_log(from_log(w)) - w), 1) << w;
}

TEST(LogWeight, OfAGreaterProbabilityIsNoLess) {
  for (int w = -kMost; w < kMost; ++w) ASSERT_LT(from_log(w), from_log(w + 1)) << w;
  int before = to_log(0.25F);
  for (float x = 0.25F; x < 1.0F; x = std::nextafter(x, 2.0F)) {
    const int now = to_log(x);
    ASSERT_GE(now, before) << x;
    before = now;
  }
}

TEST(LogWeight, OfManyProbabilitiesIsThatOfEachWithinItsBounds) {
  std::array<float, 37> probabilities;  // no multiple of what a vector unit takes at once
  for (std::size_t i = 0; i < probabilities.size(); ++i) probabilities[i] = std::exp2(-0.37F * static_cast<float>(i));
  std::array<std::int16_t, 37> logs;
  to_logs(probabilities, -5'000, logs);
  for (std::size_t i = 0; i < logs.size(); ++i) EXPECT_NEAR(logs[i], std::max(-5'000.0, -0.37 * 512.0 * static_cast<double>(i)), 0.56) << i;
}

TEST(LogWeight, OfWhatCannotBeIsTheLeastAndOfACertaintyZero) {
  constexpr float kTiny = std::numeric_limits<float>::denorm_min();
  const std::array<float, 6> probabilities{0.0F, kTiny, 1e-30F, 1.0F, std::nextafter(1.0F, 2.0F), 3.0F};
  std::array<std::int16_t, 6> logs;
  to_logs(probabilities, -19'456, logs);
  EXPECT_EQ(logs, (std::array<std::int16_t, 6>{-19'456, -19'456, -19'456, 0, 0, 0}));
}

}  // namespace
}  // namespace earshot::policy
