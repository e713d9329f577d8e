#include "sim/listening/decimator.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace earshot::listening {
namespace {

constexpr std::size_t kFactor = 4;
constexpr float kFullScale = 1.0F - 1.5F / 32'768.0F;

/// Loudest lower sample of a sine of amplitude 0.5, its frequency a share of the lower rate; the filter is full.
double loudest_of_sine(double share) {
  std::vector<float> sine(40'000);
  for (std::size_t i = 0; i < sine.size(); ++i)
    sine[i] = static_cast<float>(0.5 * std::sin(2.0 * std::numbers::pi * share * static_cast<double>(i) / kFactor));
  Decimator decimator(kFactor, kFullScale);
  const std::span<const float> lower = decimator.take(sine);
  double loudest = 0.0;
  for (const float y : lower.subspan(2 * Decimator::kReach)) loudest = std::max(loudest, static_cast<double>(std::abs(y)));
  return loudest;
}

TEST(Decimator, IsFlatWhereItPassesAndSilentWhereItWouldFold) {
  EXPECT_NEAR(loudest_of_sine(0.01), 0.5, 0.5e-3);
  EXPECT_NEAR(loudest_of_sine(0.3937), 0.5, 0.5e-2) << "of a sine that is met beside its crest";
  for (const double share : {0.6, 0.7, 0.999, 1.001, 1.4, 1.99}) EXPECT_LT(loudest_of_sine(share), 0.5 * 1.1e-5) << share;  // 99 dB
}

TEST(Decimator, GivesTheSameInPiecesOfAnySize) {
  std::vector<float> sound(1003);
  for (std::size_t i = 0; i < sound.size(); ++i) sound[i] = static_cast<float>(static_cast<int>(i * 7919 % 101) - 50) / 100.0F;
  Decimator whole(3, kFullScale);
  const std::span<const float> at_once = whole.take(sound);
  Decimator pieces(3, kFullScale);
  std::vector<float> given;
  for (std::size_t at = 0; at < sound.size(); at += 17) {
    const std::span<const float> lower = pieces.take(std::span(sound).subspan(at, std::min<std::size_t>(17, sound.size() - at)));
    given.insert(given.end(), lower.begin(), lower.end());
  }
  EXPECT_EQ(given.size(), 334U);
  EXPECT_TRUE(std::ranges::equal(given, at_once));
}

TEST(Decimator, KeepsClippedSoundApartFromLoudSound) {
  std::vector<float> sound(400, 0.25F);
  sound[200] = -1.0F;
  Decimator decimator(kFactor, kFullScale);
  const std::span<const float> lower = decimator.take(sound);
  EXPECT_EQ(std::ranges::count(lower, -1.0F), 1);
  std::vector<float> square(400);
  for (std::size_t i = 0; i < square.size(); ++i) square[i] = i / 50 % 2 == 0 ? 0.999F : -0.999F;
  decimator.restart();
  for (const float y : decimator.take(square)) EXPECT_LT(std::abs(y), kFullScale) << "a filter swings beyond a square's top";
}

TEST(Decimator, BringsEveryUsualRateToOneThatTheDetectorTakes) {
  EXPECT_EQ(decimation_for(Hertz{96'000}), 1U);
  EXPECT_EQ(decimation_for(Hertz{128'000}), 2U);
  EXPECT_EQ(decimation_for(Hertz{192'000}), 2U);
  EXPECT_EQ(decimation_for(Hertz{250'000}), 4U) << "62.5 kHz: a third is no whole number";
  EXPECT_EQ(decimation_for(Hertz{384'000}), 4U);
  EXPECT_EQ(decimation_for(Hertz{576'000}), 6U);
}

}  // namespace
}  // namespace earshot::listening
