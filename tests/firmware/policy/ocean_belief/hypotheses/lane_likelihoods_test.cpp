#include "firmware/policy/ocean_belief/hypotheses/lane_likelihoods.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "firmware/policy/belief/search_bounds.hpp"
#include "firmware/policy/likelihood/belief_grid.hpp"
#include "tests/firmware/policy/ocean_belief/ocean_rig.hpp"

namespace earshot::policy {
namespace {

/// Of two oceans, and different in everything.
constexpr std::array<Hypothesis, kLanes> kEight{{{0, 3, 2, 0, 0},
                                                 {1, 3, 2, 0, 0},
                                                 {0, 0, 2, 0, 0},
                                                 {0, 6, 2, 0, 0},
                                                 {0, 3, 0, 0, 0},
                                                 {1, 4, 3, 1, 0},
                                                 {1, 2, 1, 2, 0},
                                                 {0, 3, 2, 3, 2}}};

class LaneLikelihoodsTest : public testing::Test {
 protected:
  LaneLikelihoodsTest() {
    add_table(tables, 1.0F, [](double km) { return 30.0 - 2.0 * km; });
    add_table(tables, 1.0F, [](double km) { return 12.0 + 10.0 * std::cos(km); });
  }

  /// A unit is 0.14 %: half of one is rounded, and the table of the normal distribution is 0.2 % off at four standard deviations.
  void expect_by_hand(Reception reception) {
    likelihoods->tabulate(model, tables, kEight, reception, tables.range_count);
    for (std::size_t l = 0; l < kLanes; ++l) {
      const std::vector<double> expected = likelihoods_by_hand(model, tables, kEight[l], reception);
      for (std::size_t i = 0; i < tables.range_count; ++i) {
        ASSERT_NEAR(likelihoods->raised_by_range()[i][l] + kLeastLogLikelihood, 512.0 * std::log2(expected[i]), 2.0)
            << "lane " << l << ", range " << i;
      }
    }
  }

  BeliefModel model = small_model();
  OceanTables tables = no_tables(kSmallRanges);
  std::unique_ptr<LaneLikelihoods> likelihoods = std::make_unique<LaneLikelihoods>();
};

TEST_F(LaneLikelihoodsTest, AreByHandThoseOfWhatWasHeard) {
  for (const double snr_db : {-30.0, 4.0, 17.3, 50.0}) expect_by_hand({.snr = Decibels{snr_db}});
}

/// Ten measurements count as eight and an eighth.
TEST_F(LaneLikelihoodsTest, CountLessThanMeasurementsThatKnowNothingOfOneAnother) {
  EXPECT_EQ(tempered(-10 * kOctave), -4'160);
  EXPECT_EQ(tempered(0), 0);
}

TEST_F(LaneLikelihoodsTest, AreByHandThoseOfASoundTooFaint) {
  for (const double floor_db : {-5.0, 12.0, 31.0}) expect_by_hand({.snr = Decibels{floor_db}, .too_faint = true});
}

TEST_F(LaneLikelihoodsTest, AreNotSmoothedWhereACellIsOneRangeWide) {
  model.cells_north = 100;
  model.cells_east = 100;  // 100 m
  expect_by_hand({.snr = Decibels{20.0}});
}

/// The last that is asked for is smoothed over those behind it.
TEST_F(LaneLikelihoodsTest, AreTheSameOfFewerRangesThanTheTablesHave) {
  ASSERT_GT(half_cell(model, tables.range_step, tables.range_count), 0U);
  likelihoods->tabulate(model, tables, kEight, {.snr = Decibels{20.0}}, tables.range_count);
  const std::vector<LogLanes> all(likelihoods->raised_by_range().begin(), likelihoods->raised_by_range().end());
  ASSERT_EQ(all.size(), kSmallRanges);
  for (std::size_t count = 1; count <= kSmallRanges; ++count) {
    likelihoods->tabulate(model, tables, kEight, {.snr = Decibels{20.0}}, count);
    const std::span<const LogLanes> some = likelihoods->raised_by_range();
    ASSERT_EQ(some.size(), count);
    for (std::size_t i = 0; i < count; ++i) {
      for (std::size_t l = 0; l < kLanes; ++l) ASSERT_EQ(some[i][l], all[i][l]) << count << ", range " << i;
    }
  }
}

/// Without outliers and pauses nothing can be 600 dB loud: a likelihood of a number too small for sixteen bits, or of zero.
TEST_F(LaneLikelihoodsTest, OfWhatCannotBeAreTheLeastThatThereIsRoomForAndNeverLikely) {
  model.outlier_share = 0.0F;
  for (const double snr_db : {-kMostLevel_db, kMostLevel_db}) {
    for (const bool too_faint : {false, true}) {
      likelihoods->tabulate(model, tables, kEight, {.snr = Decibels{snr_db}, .too_faint = too_faint}, tables.range_count);
      for (const LogLanes& lanes : likelihoods->raised_by_range()) {
        for (std::size_t l = 0; l < kLanes; ++l) {
          const int log_likelihood = lanes[l] + kLeastLogLikelihood;
          ASSERT_GE(log_likelihood, kLeastLogLikelihood);
          ASSERT_LE(log_likelihood, 0);
          const bool is_certain = too_faint && (snr_db > 0.0 || kEight[l].silence > 0);
          ASSERT_TRUE(is_certain || log_likelihood < -13'000) << log_likelihood;  // 2^-25
        }
      }
    }
  }
  EXPECT_EQ(kLeastLogLikelihood + kForgotten, -32'768);
}

}  // namespace
}  // namespace earshot::policy
