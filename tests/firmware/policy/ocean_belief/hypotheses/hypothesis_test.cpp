#include "firmware/policy/ocean_belief/hypotheses/hypothesis.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <vector>

#include "tests/firmware/policy/ocean_belief/ocean_rig.hpp"

namespace earshot::policy {
namespace {

constexpr std::size_t kLevels = kLevelOffsets_db.size();
constexpr std::size_t kSpreads = kSpreads_db.size();
constexpr std::size_t kSilences = kSilenceShares.size();

/// Three oceans of 1 : 2 : 5.
OceanTables three_tables() {
  OceanTables tables = no_tables(1);
  for (const float prior : {1.0F, 2.0F, 5.0F}) add_table(tables, prior, [](double) { return 10.0; });
  return tables;
}

/// All that may be thought, of one mobility.
std::vector<Hypothesis> all_of(std::uint8_t mobility) {
  std::vector<Hypothesis> all;
  for (std::uint8_t t = 0; t < 3; ++t) {
    for (std::uint8_t l = 0; l < kLevels; ++l) {
      for (std::uint8_t s = 0; s < kSpreads; ++s) {
        for (std::uint8_t q = 0; q < kSilences; ++q) all.push_back({t, l, s, q, mobility});
      }
    }
  }
  return all;
}

double prior_of(const Hypothesis& h, const OceanTables& tables) {
  return std::exp2(log_prior(h, tables) / 512.0);
}

TEST(HypothesisPriors, AddUpToThatOfNoDrift) {
  const OceanTables tables = three_tables();
  double sum = 0.0;
  for (std::uint8_t mobility = 0; mobility < kMobilities.size(); ++mobility) {
    for (const Hypothesis& h : all_of(mobility)) sum += prior_of(h, tables);
  }
  EXPECT_NEAR(sum, std::exp2(log_prior(Drift{}) / 512.0), 2e-3);  // six logarithms, each rounded by half of 0.14 % at most
}

TEST(HypothesisPriors, AreTheProductOfThoseOfTheirParts) {
  const OceanTables tables = three_tables();
  // 5/8 of all oceans; the level as the table says; 4 dB; no pauses; at rest.
  EXPECT_NEAR(log_prior({.table = 2}, tables), 512.0 * std::log2(0.625 * 0.22 * 0.35 * 0.85 * 0.8) + log_prior(Drift{}), 3.0);
  const Drift drift{.north = 2, .is_current = true};
  const Hypothesis rare{.table = 0, .level = 6, .spread = 3, .silence = 3, .mobility = 3, .drift = drift};
  EXPECT_NEAR(log_prior(rare, tables), 512.0 * std::log2(0.125 * 0.07 * 0.1 * 0.03 * 0.04) + log_prior(drift), 3.0);
}

TEST(HypothesisPriors, ThinkASourceAsLikelyLouderAsFainter) {
  const OceanTables tables = three_tables();
  for (std::uint8_t l = 0; l < kLevels; ++l) {
    EXPECT_EQ(log_prior({.level = l}, tables), log_prior({.level = static_cast<std::uint8_t>(6 - l)}, tables));
    EXPECT_EQ(kLevelOffsets_db[l], -kLevelOffsets_db[6 - l]);
  }
}

/// Chi-square over all 336 of one kind of motion: with 335 degrees of freedom it is 335 +- 26.
TEST(HypothesisDraws, ComeFromThePrior) {
  constexpr int kDraws = 200'000;
  const OceanTables tables = three_tables();
  const std::vector<Hypothesis> all = all_of(0);
  std::vector<int> counts(all.size());
  Pcg32 random(11);
  for (int i = 0; i < kDraws; ++i) {
    const Hypothesis h = draw_hypothesis(tables, Motion::kAtRest, random);
    ASSERT_EQ(h.mobility, 0);
    ++counts[((h.table * kLevels + h.level) * kSpreads + h.spread) * kSilences + h.silence];
  }
  double at_rest = 0.0;
  for (const Hypothesis& h : all) at_rest += prior_of(h, tables);
  double chi_square = 0.0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const double expected = kDraws * prior_of(all[i], tables) / at_rest;
    chi_square += (counts[i] - expected) * (counts[i] - expected) / expected;
  }
  EXPECT_LT(chi_square, 335.0 + 5.0 * 26.0);
  EXPECT_GT(chi_square, 335.0 - 5.0 * 26.0);
}

TEST(HypothesisDraws, OfMovingSourcesTryEveryWayToMoveAsOften) {
  const OceanTables tables = three_tables();
  std::array<int, kMobilities.size()> counts{};
  Pcg32 random(12);
  for (int i = 0; i < 30'000; ++i) ++counts[draw_hypothesis(tables, Motion::kMoving, random).mobility];
  EXPECT_EQ(counts[0], 0);
  for (std::size_t m = 1; m < counts.size(); ++m) EXPECT_NEAR(counts[m], 10'000, 5 * 82) << m;  // sqrt(30 000 * 1/3 * 2/3) = 82
}

class HypothesisNeighbours : public testing::Test {
 protected:
  Hypothesis any() {
    const auto below = [this](std::size_t count) { return static_cast<std::uint8_t>(random.uniform_float() * static_cast<float>(count)); };
    const std::uint8_t table = below(3);
    const std::uint8_t level = below(kLevels);
    const std::uint8_t spread = below(kSpreads);
    const std::uint8_t silence = below(kSilences);
    return {table, level, spread, silence, below(kMobilities.size()), {}};
  }

  const OceanTables tables = three_tables();
  Pcg32 random{13};
};

TEST_F(HypothesisNeighbours, DifferInTheOceanAndAtMostOneOtherPartByOneStep) {
  int ocean_and_another = 0;
  int another = 0;
  int alike = 0;
  for (int i = 0; i < 20'000; ++i) {
    const Hypothesis parent = any();
    const Hypothesis h = draw_neighbour(parent, tables, i % 2 == 0 ? Motion::kAtRest : Motion::kMoving, random);
    ASSERT_LT(h.table, 3);
    ASSERT_LT(h.level, kLevels);
    ASSERT_LT(h.spread, kSpreads);
    ASSERT_LT(h.silence, kSilences);
    const int steps = std::abs(h.level - parent.level) + std::abs(h.spread - parent.spread) + std::abs(h.silence - parent.silence);
    ASSERT_LE(steps, 1);
    const bool is_another_ocean = h.table != parent.table;
    ocean_and_another += is_another_ocean && steps == 1 ? 1 : 0;
    another += !is_another_ocean && steps == 1 ? 1 : 0;
    alike += !is_another_ocean && steps == 0 ? 1 : 0;
  }
  EXPECT_GT(ocean_and_another, 1'000);
  EXPECT_GT(another, 4'000);
  EXPECT_LT(alike, 8'000);  // where there is no step further, or the ocean drawn is the one it was
}

TEST_F(HypothesisNeighbours, RestOrMoveAsAskedForAndMostlyAsTheyDid) {
  int as_it_did = 0;
  int moving_parents = 0;
  for (int i = 0; i < 20'000; ++i) {
    const Hypothesis parent = any();
    ASSERT_EQ(draw_neighbour(parent, tables, Motion::kAtRest, random).mobility, 0);
    const Hypothesis moving = draw_neighbour(parent, tables, Motion::kMoving, random);
    ASSERT_GT(moving.mobility, 0);
    ASSERT_LT(moving.mobility, kMobilities.size());
    if (parent.mobility == 0) continue;
    ++moving_parents;
    as_it_did += moving.mobility == parent.mobility ? 1 : 0;
  }
  EXPECT_NEAR(as_it_did, 0.8 * moving_parents, 250.0);  // 0.7, and a third of 0.3; 5 sigma of 15 000
}

TEST_F(HypothesisNeighbours, TryOceansThatThePriorThinksUnlikely) {
  OceanTables unlikely = three_tables();
  unlikely.tables[1].prior = 1e-6F;
  int tried = 0;
  for (int i = 0; i < 10'000; ++i) tried += draw_neighbour({.table = 2}, unlikely, Motion::kAtRest, random).table == 1 ? 1 : 0;
  // 0.4 of the neighbours are of any ocean, and of the others 0.3.
  EXPECT_NEAR(tried, 10'000 * (0.4 + 0.6 * 0.3) / 3.0, 5 * 40);
}

}  // namespace
}  // namespace earshot::policy
