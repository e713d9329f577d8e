#include "firmware/policy/found/found_rule.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <numbers>
#include <vector>

#include "tests/firmware/policy/belief/belief_rig.hpp"

namespace earshot::policy {
namespace {

/// 10 km x 10 km in cells of 500 m; found within 1 km.
class FoundRuleTest : public testing::Test {
 protected:
  /// @return near measurements, where the source is found
  [[nodiscard]] std::uint32_t judge(Reception reception) {
    return rule.judge({.probability = probability_within(model, cells, place), .reception = reception, .least_snr = Decibels{12.0}});
  }

  FoundRule rule;

  BeliefModel model = bare_model(at(10'000, 10'000), 20, 20);
  NorthEast place = at(3'250, 4'250);  // the centre of a cell, the seventh from the south and the ninth from the west
  std::vector<float> cells = std::vector<float>(400);
};

constexpr std::size_t kHere = 6 * 20 + 8;

class ProbabilityWithin : public FoundRuleTest {};

/// A cell of 500 m is within 1 km altogether when its centre is within 750 m, half at 1 km, not at all from 1250 m on.
TEST_F(ProbabilityWithin, CountsACellByAsMuchOfItAsLiesWithin) {
  cells[kHere] = 1.0F;
  EXPECT_FLOAT_EQ(probability_within(model, cells, place), 1.0F);
  EXPECT_FLOAT_EQ(probability_within(model, cells, place + at(-750, 0)), 1.0F);
  EXPECT_NEAR(probability_within(model, cells, place + at(0, 900)), 0.7, 1e-6);  // floats
  EXPECT_NEAR(probability_within(model, cells, place + at(600, -800)), 0.5, 1e-6);
  EXPECT_EQ(probability_within(model, cells, place + at(-1'250, 0)), 0.0F);
}

/// A circle of 1 km in 100 km2, a hundredth of pi. That its edge is 500 m wide adds 1/48 of it, and cells are 2 % coarse.
TEST_F(ProbabilityWithin, IsTheShareOfTheCircleWhereEveryPlaceIsAsLikely) {
  cells.assign(400, 1.0F / 400.0F);
  EXPECT_NEAR(probability_within(model, cells, at(5'130, 4'870)), 0.01 * std::numbers::pi * (1.0 + 1.0 / 48.0), 0.02 * 0.0314);
}

/// Those whose centres are within 1250 m, in a square around them; and at a corner of the area, and beyond.
TEST_F(ProbabilityWithin, CountsNoCellThatIsNotNear) {
  const auto spans = [](const CellWindow& window, int south, int north, int west, int east) {
    return window.north.first <= south && window.north.end > north && window.east.first <= west && window.east.end > east &&
           window.north.end - window.north.first <= north - south + 3 && window.east.end - window.east.first <= east - west + 3;
  };
  EXPECT_TRUE(spans(cells_near(model, place), 4, 8, 6, 10));
  EXPECT_TRUE(spans(cells_near(model, at(0, 9'999)), 0, 2, 18, 19));
  EXPECT_TRUE(spans(cells_near(model, at(4'000, -900)), 5, 10, 0, 0));
  cells.assign(400, 1.0F);
  EXPECT_EQ(probability_within(model, cells, at(-5'000, 20'000)), 0.0F);
  EXPECT_NEAR(probability_within(model, cells, at(5'000, -900)), 0.2926, 1e-4);  // two, 1176.86 m off
}

TEST_F(FoundRuleTest, FindsAtTheFirstMeasurementAtWhichTheSourceIsLikelyEnough) {
  cells[kHere + 1] = 0.6F;
  cells[kHere] = 0.32F;
  cells[0] = 0.08F;
  for (int measurement = 0; measurement < 7; ++measurement) EXPECT_EQ(judge({.snr = Decibels{3.0}, .too_faint = true}), 0U);
  EXPECT_EQ(judge({.snr = Decibels{14.5}}), 1U);
}

TEST_F(FoundRuleTest, DeclaresNothingThatIsNotLikelyEnough) {
  cells[kHere] = 0.89F;
  cells[399] = 0.11F;
  EXPECT_EQ(0U, judge({.snr = Decibels{14.5}}));
  cells[kHere + 20] = 0.02F;
  EXPECT_EQ(2U, judge({.snr = Decibels{14.5}}));
}

TEST_F(FoundRuleTest, DeclaresNothingThatIsHeardFainterThanItShouldBeOrNotAtAll) {
  cells[kHere] = 1.0F;
  EXPECT_EQ(1U, judge({.snr = Decibels{12.0}}));
  EXPECT_EQ(0U, judge({.snr = Decibels{11.9}}));
  EXPECT_EQ(0U, judge({.snr = Decibels{20.0}, .too_faint = true})) << "no more is known than that it lies below 20 dB";
  EXPECT_EQ(0U, judge({.snr = Decibels{std::numeric_limits<double>::quiet_NaN()}}));
}

TEST_F(FoundRuleTest, DeclaresAtTheEighthMeasurementAtWhichTheSourceIsLikelierNearThanNotAndCountsAnewThen) {
  for (int time = 0; time < 2; ++time) {
    for (int measurement = 0; measurement < 7; ++measurement) {
      cells[kHere] = 0.51F;
      EXPECT_EQ(0U, judge({.snr = Decibels{14.5}})) << measurement;
      EXPECT_EQ(0U, judge({.snr = Decibels{3.0}})) << "not as loud as it should be";
      cells[kHere] = 0.49F;
      EXPECT_EQ(0U, judge({.snr = Decibels{14.5}})) << "as likely elsewhere";
    }
    cells[kHere] = 0.51F;
    EXPECT_EQ(judge({.snr = Decibels{14.5}}), 8U) << time;
  }
}

TEST_F(FoundRuleTest, ForgetsTheMeasurementsOfTheSearchBefore) {
  cells[kHere] = 0.51F;
  for (int measurement = 0; measurement < 7; ++measurement) EXPECT_EQ(0U, judge({.snr = Decibels{14.5}}));
  rule.start();
  EXPECT_EQ(0U, judge({.snr = Decibels{14.5}}));
}

TEST_F(FoundRuleTest, DeclaresNothingOfProbabilitiesThatAreNoNumbers) {
  cells[kHere] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(0U, judge({.snr = Decibels{20.0}}));
}

}  // namespace
}  // namespace earshot::policy
