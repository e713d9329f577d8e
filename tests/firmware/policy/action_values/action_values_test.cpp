#include "firmware/policy/action_values/action_values.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "tests/firmware/policy/action_values/action_values_rig.hpp"

namespace earshot::policy {
namespace {

/// Pythagoras by hand; the source lies far from the border, so that the way to it is the distance.
TEST(FindActionValues, CostsWhatTheTablesSayAtTheRangesOfASourceThatIsKnown) {
  BeliefModel model = bare_model(at(20'000, 20'000), 40, 40);
  model.costs.find_probability = 1e-3F;
  std::vector<float> probabilities(std::size_t{40} * 40);
  probabilities[20 * 40 + 20] = 1.0F;
  std::vector<float> cost(300);
  std::vector<float> detected(300);
  for (std::size_t i = 0; i < 300; ++i) {
    cost[i] = static_cast<float>(i) * 0.01F;  // 0.1 a kilometre
    detected[i] = i < 60 ? 1.0F : 0.0F;       // within 6 km
  }
  std::array<ActionValues, 4> action_values;
  find_action_values(model, probabilities, {samples_of(cost, detected), kRangeStep}, centre(8, 20), action_values);  // 6 km south of it
  EXPECT_NEAR(action_values[kSouth].regret, 0.2F, 1e-5F);                             // 7 km of way instead of 5
  EXPECT_NEAR(action_values[kEast].regret, 0.1F * (std::sqrt(37.0F) - 5.0F), 1e-4F);  // linear between ranges 100 m apart
  EXPECT_EQ(action_values[kNorth].regret, 0.0F);
  EXPECT_EQ(action_values[kNorth].detected, 1.0F);
  EXPECT_EQ(action_values[kSouth].detected, 0.0F);
  EXPECT_EQ(action_values[kNorth].found, 0.0F);
  EXPECT_EQ(action_values[kNorth].find_probability, 0.0F);
}

/// What lies near a vehicle at (0, 4500) m reaches north by 4.5 km, the middle of the one cell: just one cell is to be looked at.
TEST(FindActionValues, FindsInTheOneCellOfAnAreaAsMuchAsLiesWithinAStep) {
  const BeliefModel model = bare_model(at(9'000, 9'000), 1, 1);
  const std::array probabilities = {1.0F};
  const std::array<float, 2> table{};
  std::array<ActionValues, 4> action_values;
  find_action_values(model, probabilities, {samples_of(table, table), kRangeStep}, at(0, 4'500), action_values);
  EXPECT_FLOAT_EQ(action_values[kNorth].found, 2.0F / 9.0F);  // 3.5 km from its centre: 1 - 3.5 + 9 / 2 km of its side
}

/// A belief that is put down cell by cell on a strip of 12.5 km x 31 km, in cells of 500 m north by 1000 m east. Steps of 1 km, a border of
/// 2 km, so that it is left alone from 2 km to 10.5 km north and from 2 km to 29 km east. Tables in steps of 100 m.
class StripTest : public testing::Test {
 protected:
  static constexpr std::size_t kColumns = 31;

  StripTest() {
    model.border_width = Meters{2'000};
    model.costs.find_discount = 0.9F;
  }

  /// The cell whose centre is (500 row + 250, 1000 column + 500) m.
  float& cell(std::size_t row, std::size_t column) { return probabilities[row * kColumns + column]; }
  /// All of the belief in one cell, in the middle of the strip: its centre is (6250, 15500) m.
  void know_the_middle() { cell(12, 15) = 1.0F; }
  void find(NorthEast position) {
    find_action_values(model, std::span(probabilities).first(25 * kColumns), {samples_of(cost, detected), kRangeStep}, position,
                       std::span(action_values).first(4));
  }
  /// As tables by range a straight line: `per_kilometre` of each.
  static std::vector<float> ramp(float per_kilometre) {
    std::vector<float> table(500);
    for (std::size_t i = 0; i < table.size(); ++i) table[i] = 0.1F * per_kilometre * static_cast<float>(i);
    return table;
  }

  BeliefModel model = bare_model(at(12'500, 31'000), 25, 31);
  /// A row more than there is, of places that are likelier than any: nobody may look at it.
  std::vector<float> probabilities = [] {
    std::vector<float> cells(26 * kColumns);
    std::fill(cells.end() - kColumns, cells.end(), 0.5F);
    return cells;
  }();
  std::vector<float> cost = std::vector<float>(500);
  std::vector<float> detected = std::vector<float>(500);
  std::array<ActionValues, 5> action_values{};  ///< of four actions; nobody may touch the fifth
};

TEST_F(StripTest, LeavesAloneWhatIsNoActions) {
  know_the_middle();
  action_values[4] = {.found = 0.1F, .find_probability = 0.2F, .detected = 0.3F, .border = 0.4F, .regret = 0.5F};
  find(at(4'250, 14'500));
  EXPECT_EQ(action_values[4].found, 0.1F);
  EXPECT_EQ(action_values[4].find_probability, 0.2F);
  EXPECT_EQ(action_values[4].detected, 0.3F);
  EXPECT_EQ(action_values[4].border, 0.4F);
  EXPECT_EQ(action_values[4].regret, 0.5F);
}

TEST(ActionValues, PromisesNothingBeforeItIsFound) {
  const ActionValues blank;
  for (const float promise : {blank.found, blank.find_probability, blank.detected, blank.border, blank.regret}) EXPECT_EQ(promise, 0.0F);
}

/// A cell 1200 m from a step's end sticks into a step length of 1000 m by 1000 - 1200 + 1000 / 2 = 300 m of its longer side, 1000 m.
TEST_F(StripTest, FindsInACellAsMuchAsLiesWithinAStepOfAStepsEnd) {
  cell(12, 15) = 0.5F;      // (6250, 15500)
  cell(10, 14) = 0.3F;      // (5250, 14500)
  cell(0, 0) = 0.2F;        // far away
  find(at(5'530, 13'540));  // east is (5530, 14540): 720 m and 960 m from the one, 280 m and 40 m from the other
  EXPECT_NEAR(action_values[kEast].found, 0.5F * 0.3F + 0.3F, 1e-5F);  // metres to seven places
  EXPECT_NEAR(action_values[kSouth].found, 0.3F * 0.3F, 1e-5F);        // south is (4530, 13540): 720 m and 960 m from the other
  EXPECT_EQ(action_values[kNorth].found, 0.0F);                        // 1.6 km from the nearer
  EXPECT_EQ(action_values[kWest].found, 0.0F);                         // 2 km
}

TEST_F(StripTest, FindsNoMoreThanAllOfACell) {
  cell(12, 15) = 0.5F;
  find(at(6'250, 14'995));  // east ends 495 m from its centre: all of its side and 5 m are within a step length
  EXPECT_EQ(action_values[kEast].found, 0.5F);
}

/// The place (0, 0) holds nothing: what fills up the last eight of the cells that are looked at together must not count.
TEST_F(StripTest, FindsWhatLiesInTheCornerOfTheArea) {
  cell(0, 0) = 0.25F;  // (250, 500)
  cell(0, 4) = 0.5F;   // (250, 4500): too far
  find(at(1'250, 500));
  EXPECT_EQ(action_values[kSouth].found, 0.25F);
  cell(0, 0) = 0.0F;
  cell(1, 1) = 0.25F;  // (750, 1500): 1118 m away, 1000 - 1118.03 + 500 m of its side within a step length
  find(at(1'250, 500));
  EXPECT_NEAR(action_values[kSouth].found, 0.25F * 0.381966F, 1e-6F);
}

TEST_F(StripTest, LiesInTheBorderAsDeepAsTheNearerOfItsEdgesIsNear) {
  find(at(10'500, 27'800));
  EXPECT_FLOAT_EQ(action_values[kNorth].border, 0.5F);  // 11.5 km of 10.5 km to 12.5 km
  EXPECT_FLOAT_EQ(action_values[kEast].border, 0.0F);   // 28.8 km of 29 km to 31 km
  find(at(10'800, 28'600));
  EXPECT_FLOAT_EQ(action_values[kNorth].border, 0.65F);  // north 1.3 km deep
  EXPECT_FLOAT_EQ(action_values[kEast].border, 0.3F);    // east 0.6 km deep, north 0.3 km
  EXPECT_FLOAT_EQ(action_values[kSouth].border, 0.0F);
  EXPECT_FLOAT_EQ(action_values[kWest].border, 0.15F);  // north 0.3 km deep
  find(at(1'500, 600));
  EXPECT_FLOAT_EQ(action_values[kNorth].border, 0.7F);   // west 1.4 km deep
  EXPECT_FLOAT_EQ(action_values[kEast].border, 0.25F);   // south 0.5 km deep, west 0.4 km
  EXPECT_FLOAT_EQ(action_values[kSouth].border, 0.75F);  // south 1.5 km deep
  EXPECT_FLOAT_EQ(action_values[kWest].border, 1.2F);    // beyond the edge
}

/// The tables are straight lines, so that what is expected of them is the mean distance, by Pythagoras.
TEST_F(StripTest, ExpectsOfADetectionItsMeanOverBlocksOfCells) {
  cell(10, 12) = 0.05F;  // four cells of 2 x 2: 0.7 of their 0.5 lie in the northern two, 0.6 in the eastern two,
  cell(10, 13) = 0.1F;   // which makes a point at (5250 + 0.7 500, 12500 + 0.6 1000) = (5600, 13100)
  cell(11, 12) = 0.15F;
  cell(11, 13) = 0.2F;
  cell(24, 20) = 0.05F;  // two in the last row, at (12250, 20500 + 0.75 1000)
  cell(24, 21) = 0.15F;
  cell(4, 30) = 0.15F;  // two in the last column, at (2250 + 0.25 500, 30500)
  cell(5, 30) = 0.05F;
  cell(24, 30) = 0.05F;   // one in the corner of both
  cell(6, 0) = 0.05F;     // and one at (3250, 500), which follows in memory on the row of the last column's
  cell(0, 0) = 0.00019F;  // less than 0.0002: left out
  detected = ramp(0.01F);
  find(at(2'600, 8'100));
  const auto mean_from = [](double north, double east) {
    return 0.5 * std::hypot(5'600 - north, 13'100 - east) + 0.2 * std::hypot(12'250 - north, 21'250 - east) +
           0.2 * std::hypot(2'375 - north, 30'500 - east) + 0.05 * std::hypot(12'250 - north, 30'500 - east) +
           0.05 * std::hypot(3'250 - north, 500 - east);
  };
  EXPECT_NEAR(double{action_values[kNorth].detected}, 1e-5 * mean_from(3'600, 8'100), 1e-6);  // of floats below one, a dozen roundings
  EXPECT_NEAR(double{action_values[kEast].detected}, 1e-5 * mean_from(2'600, 9'100), 1e-6);
  EXPECT_NEAR(double{action_values[kSouth].detected}, 1e-5 * mean_from(1'600, 8'100), 1e-6);
  EXPECT_NEAR(double{action_values[kWest].detected}, 1e-5 * mean_from(2'600, 7'100), 1e-6);
}

TEST_F(StripTest, HoldsBeyondATablesEndWhatItsEndSays) {
  know_the_middle();
  detected = {0.9F, 0.8F, 0.7F};
  cost = {1.0F, 2.0F, 3.0F};
  find(at(6'250, 5'500));  // 10 km away, and the tables end at 200 m
  for (std::size_t action = 0; action < 4; ++action) {
    EXPECT_FLOAT_EQ(action_values[action].detected, 0.7F);
    EXPECT_EQ(action_values[action].regret, 0.0F);
  }
}

/// 500 samples to 49.9 km and a step's end at 9 km or 8.95 km; of the table 90 or 91 samples, to 8.9 km or 9 km, are the model's.
TEST_F(StripTest, ReadsATableToItsLastSampleAndNoFurther) {
  know_the_middle();
  std::vector<float> table = ramp(0.01F);
  std::fill(table.begin() + 91, table.end(), std::numeric_limits<float>::quiet_NaN());
  const auto detected_at = [&](double range_m, std::size_t samples) {
    find_action_values(model, std::span(probabilities).first(25 * kColumns),
                       {samples_of(cost, std::span(table).first(samples)), kRangeStep}, at(6'250, 15'500 - range_m - 1'000),
                       std::span(action_values).first(4));
    return action_values[kEast].detected;
  };
  EXPECT_FLOAT_EQ(detected_at(8'950, 91), 0.0895F);
  EXPECT_FLOAT_EQ(detected_at(9'000, 91), 0.09F);
  EXPECT_FLOAT_EQ(detected_at(9'050, 91), 0.09F);
  EXPECT_FLOAT_EQ(detected_at(8'950, 90), 0.089F);
}

TEST_F(StripTest, LeavesOutABlockOfLessThanATwoThousandthHalf) {
  detected = ramp(0.01F);
  cell(12, 20) = 0.00021F;  // 10.0 km from the end of a step east: nothing else is known, so it counts as all
  find(at(6'250, 9'500));
  EXPECT_NEAR(action_values[kEast].detected, 0.1F, 1e-6F);
  cell(12, 20) = 0.00019F;
  find(at(6'250, 9'500));
  for (const ActionValues& values : action_values) {  // nothing is known at all
    EXPECT_EQ(values.detected, 0.0F);
    EXPECT_EQ(values.regret, 0.0F);
  }
  cell(12, 20) = 2e-4F;  // no less
  find(at(6'250, 9'500));
  EXPECT_NEAR(action_values[kEast].detected, 0.1F, 1e-6F);
}

/// From (4250, 14500) the source lies 2 km north and 1 km east: three steps lead there. Two of them end 1 km away, where half of its cell
/// is within a step length; north alone, with the other two undoing each other, sqrt(2) km away, 1000 - 1414.2 + 500 = 85.8 m of its side.
TEST_F(StripTest, FindsInThreeStepsWhateverTheirOrder) {
  know_the_middle();
  find(at(4'250, 14'500));
  EXPECT_NEAR(action_values[kNorth].find_probability, 0.81F, 1e-5F);  // discounted twice; two steps: 0.9 0.5
  EXPECT_NEAR(action_values[kEast].find_probability, 0.81F, 1e-5F);
  EXPECT_NEAR(action_values[kSouth].find_probability, 0.81F * 0.0857864F, 1e-5F);  // south, north, north
  EXPECT_NEAR(action_values[kWest].find_probability, 0.81F * 0.0857864F, 1e-5F);   // west, north, east
}

/// Three steps straight on end 1400 m from it: 100 m of the cell's side are within reach; two steps and one aside 2.6 km.
TEST_F(StripTest, FindsAsFarAsThreeStepsInEveryDirection) {
  know_the_middle();
  const std::array from = {at(1'850, 15'500), at(6'250, 11'100), at(10'650, 15'500), at(6'250, 19'900)};
  for (std::size_t direction = 0; direction < 4; ++direction) {
    find(from[direction]);
    for (std::size_t action = 0; action < 4; ++action)
      EXPECT_NEAR(action_values[action].find_probability, action == direction ? 0.081F : 0.0F, 1e-5F) << direction << ' ' << action;
  }
}

/// The source lies at (11250, 15500), 750 m of 2000 m deep in the border. Two steps north end there, which costs 12 / 30 of 0.375.
TEST_F(StripTest, TakesTheBordersCostOffWhatItFinds) {
  cell(22, 15) = 1.0F;
  model.costs.edge = 12.0F;
  model.costs.find_probability = 30.0F;
  model.costs.most_regret = 11.0F;
  find(at(9'250, 15'500));
  EXPECT_NEAR(action_values[kNorth].find_probability, 0.9F - 0.15F, 1e-5F);
  EXPECT_NEAR(action_values[kEast].find_probability, 0.405F,
              1e-5F);  // east, west, north: 1 km from the source, discounted twice; no border
  EXPECT_NEAR(action_values[kSouth].find_probability, 0.405F, 1e-5F);
  EXPECT_EQ(action_values[kNorth].regret, 0.0F);
  EXPECT_NEAR(action_values[kWest].regret, 30.0F * (0.75F - 0.405F), 1e-3F);  // no search costs anything here, and no step's end either
  model.costs.most_regret = 10.0F;
  find(at(9'250, 15'500));
  EXPECT_EQ(action_values[kWest].regret, 10.0F);
  model.costs.edge = 1e6F;
  find(at(9'250, 15'500));
  EXPECT_NEAR(action_values[kNorth].find_probability, 0.5F, 1e-5F);  // the end of the first step, on this side of the border
}

TEST_F(StripTest, FindsNothingWhereTheBorderCostsMoreThanAllOfIt) {
  cell(24, 15) = 1.0F;  // (12250, 15500)
  model.costs.edge = 30.0F;
  model.costs.find_probability = 10.0F;
  find(at(11'750, 15'500));  // a metre nearer is a thousandth more within reach, and three two-thousandths more border
  for (const ActionValues& values : action_values) EXPECT_EQ(values.find_probability, 0.0F);
}

/// The vehicle stands where the border begins, the source 750 m into it: found from within 1 km, which is sqrt(1 - 0.75^2) = 0.6614 km
/// along the border, 338.6 m more of the way than the step length that a search needs not go.
TEST_F(StripTest, GoesToASourceInTheBorderWithoutEnteringIt) {
  cell(22, 15) = 1.0F;  // (11250, 15500)
  cost = ramp(1.0F);
  model.costs.find_probability = 1e-3F;
  model.costs.edge = 4.0F;
  find(at(10'500, 15'500));
  EXPECT_EQ(action_values[kEast].regret, 0.0F);  // 1 km along the border and 0.3386 km: further than the source, sqrt(1 + 0.75^2) km away
  EXPECT_EQ(action_values[kWest].regret, 0.0F);
  EXPECT_NEAR(action_values[kSouth].regret, 1.75F - 1.338562F, 1e-4F);  // straight on to the source is further
  EXPECT_NEAR(action_values[kNorth].regret, 4.0F * 0.5F, 1e-4F);        // as far as east, and half of the border deep
}

TEST_F(StripTest, GoesAWholeStepMoreForASourceThatCannotBeFoundFromOutsideTheBorder) {
  cell(23, 15) = 1.0F;  // (11750, 15500), 1250 m deep
  cost = ramp(1.0F);
  model.costs.find_probability = 1e-3F;
  model.costs.edge = 0.0F;
  find(at(10'500, 15'500));
  EXPECT_NEAR(action_values[kEast].regret, 0.0F, 1e-3F);  // 1 km along the border and a step; find probabilities are worth up to 1e-3
  EXPECT_NEAR(action_values[kSouth].regret, 2.25F - 2.0F, 1e-3F);  // straight on
  EXPECT_NEAR(action_values[kNorth].regret, 0.0F, 1e-3F);          // back by 1 km, and a step
}

TEST_F(StripTest, FindsNoCellOfLessThanAThousandth) {
  cell(12, 15) = 0.0011F;
  find(at(6'250, 14'500));
  EXPECT_EQ(action_values[kEast].found, 0.0011F);
  cell(12, 15) = 1e-3F;
  find(at(6'250, 14'500));
  EXPECT_EQ(action_values[kEast].found, 1e-3F);
  cell(12, 15) = 0.0009F;
  find(at(6'250, 14'500));
  EXPECT_EQ(action_values[kEast].found, 0.0F);
}

TEST_F(StripTest, LooksAtMoreLikelyCellsOnlyWhereMoreThanSixtyFourAreNear) {
  const NorthEast place = at(6'250, 14'500);
  for (std::size_t i = 0; i < 63; ++i) cell(12 + i / 9, 10 + i % 9) = 0.002F;  // seven rows of nine from there on
  cell(12, 15) = 0.5F;                                                         // where east ends
  find(place);
  const float all_of_them = action_values[kEast].found;
  cell(11, 15) = 0.00402F;  // the sixty-fourth, 500 m from there
  find(place);
  EXPECT_NEAR(action_values[kEast].found, all_of_them + 0.00402F, 1e-6F);
  cell(11, 14) = 0.00398F;  // one too many: from now on 0.004 is the least
  find(place);
  EXPECT_NEAR(action_values[kEast].found, 0.50402F, 1e-6F);
}

TEST_F(StripTest, FindsNothingWhereHardlyAnyOfTheBeliefIsNear) {
  cell(12, 15) = 0.0101F;
  find(at(6'250, 14'500));
  EXPECT_NEAR(action_values[kEast].find_probability, 0.0101F, 1e-6F);
  cell(12, 15) = 0.01F;
  find(at(6'250, 14'500));
  EXPECT_NEAR(action_values[kEast].find_probability, 0.01F, 1e-6F);
  cell(12, 15) = 0.0099F;
  find(at(6'250, 14'500));
  EXPECT_EQ(action_values[kEast].find_probability, 0.0F);
  EXPECT_EQ(action_values[kEast].found, 0.0099F);
}

TEST_F(StripTest, CountsAsNearOnlyTheCellsThatItLooksAtInTheEnd) {
  for (std::size_t i = 0; i < 70; ++i) cell(8 + i / 9, 10 + i % 9) = 0.002F;  // too many, 0.14 in all: all of them are left out
  cell(12, 15) = 0.0099F;
  find(at(6'250, 14'500));
  EXPECT_EQ(action_values[kEast].found, 0.0099F);
  EXPECT_EQ(action_values[kEast].find_probability, 0.0F);
}

}  // namespace
}  // namespace earshot::policy
