#include "firmware/policy/belief.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <span>
#include <vector>

#include "firmware/core/crc32.hpp"
#include "firmware/core/random.hpp"
#include "tests/firmware/policy/belief_rig.hpp"

namespace earshot::policy {
namespace {

TEST_F(BeliefTest, StartsWithEveryPlaceAsLikelyAsAnyOther) {
  const BeliefModel model = flat_model({{0.0F, 2.0F, 1.0F}});
  belief->start(model);
  for (std::size_t n = 0; n < 40; ++n) {
    for (std::size_t e = 0; e < 40; ++e) EXPECT_FLOAT_EQ(belief->probability(model, n, e), 1.0F / 1600.0F);
  }
}

/// Bayes' rule with every factor written out, in long double, over places beyond reach.
std::vector<long double> by_hand(const std::vector<std::pair<NorthEast, Reception>>& looks, const BeliefModel& model) {
  std::vector<long double> joint(std::size_t{40} * 40 * model.hypotheses.size());
  long double total = 0.0L;
  for (std::size_t h = 0; h < model.hypotheses.size(); ++h) {
    const auto sigma = static_cast<long double>(model.hypotheses[h].spread_db);
    const auto outlier = static_cast<long double>(model.outlier_share);
    const auto silent = static_cast<long double>(model.silence_share);
    for (std::size_t i = 0; i < 1600; ++i) {
      long double p = static_cast<long double>(model.hypotheses[h].prior);
      for (const auto& [place, reception] : looks) {
        const long double expected =
            static_cast<long double>(snr_at(place, centre(i / 40, i % 40)) + double{model.hypotheses[h].level_offset_db});
        const long double z = (static_cast<long double>(reception.snr.value) - expected) / sigma;
        const long double density = std::exp(-0.5L * z * z) / (sigma * std::sqrt(2.0L * std::numbers::pi_v<long double>));
        const long double below = 0.5L * std::erfc(-z / std::sqrt(2.0L));
        p *= !reception.too_faint ? (1.0L - silent) * ((1.0L - outlier) * density + outlier / 80.0L)
                                  : silent + (1.0L - silent) * ((1.0L - outlier) * below + outlier * 0.5L);
      }
      joint[h * 1600 + i] = p;
      total += p;
    }
  }
  for (long double& p : joint) p /= total;
  return joint;
}

TEST_F(BeliefTest, IsWhatBayesRuleGivesByHand) {
  BeliefModel model = flat_model({{0.0F, 3.0F, 2.0F}, {4.0F, 5.0F, 1.0F}, {-4.0F, 4.0F, 1.0F}});
  model.outlier_share = 0.05F;
  model.silence_share = 0.1F;
  // From outside the area, so that no look rules a place out by having been there.
  const std::vector<std::pair<NorthEast, Reception>> looks = {{at(-2'000, 3'000), {.snr = Decibels{21.0}}},
                                                              {at(-2'000, 9'000), {.snr = Decibels{17.5}}},
                                                              {at(5'000, -2'000), {.snr = Decibels{15.0}, .too_faint = true}},
                                                              {at(21'000, 21'000), {.snr = Decibels{9.0}}}};
  belief->start(model);
  for (const auto& [place, reception] : looks) belief->update(model, place, reception);

  const std::vector<long double> expected = by_hand(looks, model);
  for (std::size_t i = 0; i < 1600; ++i) {
    const auto p = static_cast<double>(expected[i] + expected[1600 + i] + expected[3200 + i]);
    // Ranges are rounded to 100 m, which is 0.05 dB, and smoothed over the cell: at up to 3 sigma of 3 dB, 5 % a look at the very most,
    // and some of four looks the one way, some the other.
    EXPECT_NEAR(double{belief->probability(model, i / 40, i % 40)}, p, 0.08 * p) << i;
  }
  for (std::size_t h = 0; h < 3; ++h) {
    long double share = 0.0L;
    for (std::size_t i = 0; i < 1600; ++i) share += expected[h * 1600 + i];
    EXPECT_NEAR(double{belief->probability_of_hypothesis(h)}, static_cast<double>(share), 0.01);
  }
}

TEST_F(BeliefTest, FindsTheSourceWhereThreeLooksMeet) {
  const BeliefModel model = flat_model({{0.0F, 0.2F, 1.0F}});
  const NorthEast source = centre(27, 11);
  belief->start(model);
  for (const NorthEast place : {at(2'000, 2'000), at(15'000, 18'000), at(3'000, 17'000)}) hear(model, place, snr_at(place, source));
  EXPECT_EQ(belief->summary().likeliest, source);
  EXPECT_LT(range_between(belief->summary().mean, source).value, 250.0);
  EXPECT_LT(belief->summary().spread.value, 500.0);
}

TEST_F(BeliefTest, TakesASignalTooFaintToMeasureForOneBelowTheFloorHoweverFar) {
  const BeliefModel model = flat_model({{0.0F, 2.0F, 1.0F}});
  const NorthEast place = centre(20, 0);
  belief->start(model);
  hear_nothing(model, place, 25.0);  // the model's SNR 5 km away
  // The normal distribution's table: half at the mean, 0.8413 and 0.1587 a standard deviation, which is 2 km, beyond and before it.
  const double far = probability_at(model, centre(20, 39));
  EXPECT_NEAR(probability_at(model, centre(20, 10)) / far, 0.5, 0.01);  // of what the furthest cell, 7 sigma beyond, has
  EXPECT_NEAR(probability_at(model, centre(20, 14)) / far, 0.8413, 0.01);
  EXPECT_NEAR(probability_at(model, centre(20, 6)) / far, 0.1587, 0.01);
}

TEST_F(BeliefTest, LearnsLittleFromSilenceWhereCallsMayPause) {
  BeliefModel model = flat_model({{0.0F, 2.0F, 1.0F}});
  model.silence_share = 0.5F;
  const NorthEast place = centre(20, 0);
  belief->start(model);
  hear_nothing(model, place, 10.0);
  // A source 2 km away is heard for certain when it calls: half of what one has that could never be heard, and one 20 km away is at the
  // floor.
  EXPECT_NEAR(probability_at(model, centre(20, 4)) / probability_at(model, centre(20, 39)), 0.5 / (0.5 + 0.5 * 0.4), 0.02);
}

TEST_F(BeliefTest, RulesOutWhereTheVehicleHasBeen) {
  const BeliefModel model = flat_model({{0.0F, 8.0F, 1.0F}});
  belief->start(model);
  hear(model, centre(20, 20), 25.0);
  EXPECT_LT(probability_at(model, centre(20, 21)), 0.01 * probability_at(model, centre(20, 24)));
}

TEST_F(BeliefTest, ComesBackFromAHundredLooksThatWereWrong) {
  BeliefModel model = flat_model({{0.0F, 1.0F, 1.0F}});
  model.outlier_share = 0.02F;
  model.forgotten_share = 1e-4F;
  const NorthEast wrong = centre(35, 35);
  const NorthEast right = centre(4, 30);
  belief->start(model);
  Pcg32 random(5);
  const auto anywhere = [&random] { return at(20'000 * random.uniform_double(), 20'000 * random.uniform_double()); };
  for (int i = 0; i < 100; ++i) {
    const NorthEast place = anywhere();
    hear(model, place, snr_at(place, wrong));
  }
  for (std::size_t i = 0; i < 1600; ++i) ASSERT_GT(belief->probability(model, i / 40, i % 40), 0.0F) << i;
  for (int i = 0; i < 10; ++i) {
    const NorthEast place = anywhere();
    hear(model, place, snr_at(place, right));
  }
  EXPECT_LT(range_between(belief->summary().likeliest, right).value, 1'000.0);
}

TEST_F(BeliefTest, KnowsNoMoreWhenItHearsWhatCannotBe) {
  const BeliefModel model = flat_model({{0.0F, 0.1F, 1.0F}});  // no outliers, and nothing is as loud as this
  belief->start(model);
  hear(model, at(10'000, 10'000), 900.0);
  EXPECT_NEAR(belief->probability(model, 3, 3), 1.0 / 1600.0, 0.01 / 1600.0);  // but for the dozen cells it has been at
}

/// A spread whose inverse is infinite makes likelihoods NaN: parse() refuses it, and the belief must come to an end all the same.
TEST_F(BeliefTest, ComesToAnEndWithASpreadThatParseRefuses) {
  BeliefModel model = flat_model({{0.0F, 1e-39F, 1.0F}});
  EXPECT_FALSE(has_valid_numbers(model));
  belief->start(model);
  hear(model, at(10'000, 10'000), 20.0);
  EXPECT_EQ(belief->probability(model, 3, 3), 1.0F / 1600.0F);
  EXPECT_TRUE(std::isfinite(belief->outlook(kNorth).regret));
}

TEST_F(BeliefTest, FindsOutThatTheSourceIsLouderThanTheModelSays) {
  const BeliefModel model = flat_model({{0.0F, 2.0F, 2.0F}, {-6.0F, 2.0F, 1.0F}, {6.0F, 2.0F, 1.0F}});
  const NorthEast source = centre(10, 10);
  belief->start(model);
  for (const NorthEast place :
       {at(2'000, 18'000), at(18'000, 2'000), at(18'000, 18'000), at(9'000, 9'000), at(1'000, 1'000), at(12'000, 4'000)}) {
    hear(model, place, snr_at(place, source) + 6.0);
  }
  EXPECT_GT(belief->probability_of_hypothesis(2), 0.8F);
}

TEST_F(BeliefTest, HasTheSameBitsOnEveryMachine) {
  BeliefModel model = flat_model({{0.0F, 1.0F, 2.0F}, {0.0F, 4.0F, 2.0F}, {-6.0F, 4.0F, 1.0F}, {6.0F, 4.0F, 1.0F}});
  model.outlier_share = 0.02F;
  model.forgotten_share = 1e-4F;
  belief->start(model);
  Pcg32 random(9);
  for (int i = 0; i < 50; ++i) {
    const double north_m = 20'000 * random.uniform_double();  // one after the other: arguments are drawn in any order
    const double east_m = 20'000 * random.uniform_double();
    belief->update(model, at(north_m, east_m), {.snr = Decibels{30.0 * random.uniform_double()}, .too_faint = i % 5 == 0});
  }
  std::vector<float> all;
  for (std::size_t i = 0; i < 1600; ++i) all.push_back(belief->probability(model, i / 40, i % 40));
  for (std::size_t a = 0; a < 4; ++a) {
    const ActionOutlook& outlook = belief->outlook(a);
    all.insert(all.end(), {outlook.found, outlook.reach, outlook.detected, outlook.border, outlook.regret});
  }
  const std::span<const std::uint8_t> bytes(reinterpret_cast<const std::uint8_t*>(all.data()), all.size() * sizeof(float));
  EXPECT_EQ(crc32(bytes), 0xF814D605U);  // of x86-64, unoptimised for SSE2 as well as vectorised for AVX2, and of 64-bit ARM
}

}  // namespace
}  // namespace earshot::policy
