#include "firmware/policy/likelihood/reception_likelihood.hpp"

#include <gtest/gtest.h>

#include <array>

namespace earshot::policy {
namespace {

/// As the printed table of the normal distribution has it at 0, 1 and 2 standard deviations: density 0.39894, 0.24197, 0.05399; below
/// 0.5, 0.84134, 0.97725.
constexpr ReceptionModel kPlain{.level_offset_db = 3.0F, .spread_db = 5.0F, .silence_share = 0.0F, .outlier_share = 0.0F};
constexpr ReceptionModel kRough{.level_offset_db = 3.0F, .spread_db = 5.0F, .silence_share = 0.2F, .outlier_share = 0.1F};
constexpr Reception kHeard{.snr = Decibels{23.0}};
constexpr Reception kUnheard{.snr = Decibels{23.0}, .too_faint = true};

void expect(const ReceptionModel& model, Reception reception, std::array<float, 3> expected) {
  std::array<float, 3> values{20.0F, 15.0F, 10.0F};
  to_likelihoods(model, reception, values);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(values[i], expected[i], 1e-5F) << i;
}

TEST(ReceptionLikelihood, OfASoundIsTheDensityPerDecibel) {
  expect(kPlain, kHeard, {0.079788F, 0.048394F, 0.010798F});
}

TEST(ReceptionLikelihood, OfFaintnessIsTheProbabilityToLieBelow) {
  expect(kPlain, kUnheard, {0.5F, 0.841345F, 0.977250F});
}

TEST(ReceptionLikelihood, OfASoundLeavesWhatPausesAndOutliersDo) {
  // 0.8 (0.9 d / 5 + 0.1 / 80)
  expect(kRough, kHeard, {0.058448F, 0.035844F, 0.008775F});
}

TEST(ReceptionLikelihood, OfFaintnessAddsPausesAndHalfOfTheOutliers) {
  // 0.2 + 0.8 (0.9 p + 0.05)
  expect(kRough, kUnheard, {0.6F, 0.845768F, 0.943620F});
}

}  // namespace
}  // namespace earshot::policy
