#include "policy/ppo/advantage.hpp"

#include <gtest/gtest.h>

#include <array>

namespace earshot::ppo {
namespace {

// gamma = 0.5 and lambda = 0.5 make every number below exact in a float.
constexpr std::array<float, 3> kRewards{1.0F, 2.0F, 4.0F};
constexpr std::array<float, 3> kValues{8.0F, 16.0F, 32.0F};

std::array<float, 3> estimated(std::array<std::uint8_t, 3> starts, bool next_starts) {
  std::array<float, 3> advantages{};
  estimate_advantages({kRewards, kValues, starts, 64.0F, next_starts}, 0.5, 0.5, advantages);
  return advantages;
}

TEST(Advantage, AddsDiscountedTemporalDifferencesBackwards) {
  // delta = 1 + 8 - 8 = 1, 2 + 16 - 16 = 2, 4 + 32 - 32 = 4; A2 = 4, A1 = 2 + 4/4 = 3, A0 = 1 + 3/4 = 1.75.
  EXPECT_EQ(estimated({1, 0, 0}, false), (std::array<float, 3>{1.75F, 3.0F, 4.0F}));
}

TEST(Advantage, TakesNothingFromBeyondTheEndOfTheLastEpisode) {
  // delta2 = 4 - 32 = -28; A1 = 2 - 28/4 = -5; A0 = 1 - 5/4 = -0.25.
  EXPECT_EQ(estimated({1, 0, 0}, true), (std::array<float, 3>{-0.25F, -5.0F, -28.0F}));
}

TEST(Advantage, StopsAtAnEpisodeThatStartsInTheMiddle) {
  // The step at 1 ended an episode: delta1 = 2 - 16 = -14 = A1, A0 = 1 - 14/4 = -2.5; the new episode at 2: A2 = 4.
  EXPECT_EQ(estimated({1, 0, 1}, false), (std::array<float, 3>{-2.5F, -14.0F, 4.0F}));
}

}  // namespace
}  // namespace earshot::ppo
