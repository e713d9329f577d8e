// The belief on areas that are not square, with every number worked out by hand.
#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <numeric>

#include "tests/firmware/policy/belief_rig.hpp"

namespace earshot::policy {
namespace {

/// An oblong of 2 km x 9 km in 2 x 3 cells of 1 km x 3 km. Cells 3, 6 and 9 km away are modelled at 20, 15 and 10 dB; the signal spreads by
/// 5 dB. No smoothing: half of a cell is less than a range step. So much is heard from 1.5 km west of the area that the printed table of
/// the normal distribution, at 0, 1 and 2 standard deviations, is all that is needed: density 0.39894, 0.24197, 0.05399; below 0.5,
/// 0.84134, 0.97725. Both rows have the same, but for a few metres that range steps round away.
class OblongTest : public BeliefTest {
 protected:
  OblongTest() {
    EXPECT_EQ(model.hypotheses.push_back({.level_offset_db = 0.0F, .spread_db = 5.0F, .prior = 3.0F}), Status::kOk);
    for (const float snr : {25.0F, 20.0F, 15.0F, 10.0F}) EXPECT_EQ(model.snr_db.push_back(snr), Status::kOk);
    model.range_step = Meters{3'000};
  }

  void expect(std::array<double, 3> columns) const {
    for (std::size_t i = 0; i < 6; ++i)
      EXPECT_NEAR(double{belief->probability(model, i / 3, i % 3)}, columns[i % 3], 1e-6) << i;  // floats below one, a few roundings
  }

  static constexpr NorthEast kWestOfIt{.north = Meters{500}, .east = Meters{-1'500}};
  BeliefModel model = bare_model(at(2'000, 9'000), 2, 3);
};

TEST_F(OblongTest, WeighsEveryCellByTheDensityAtItsRange) {
  belief->start(model);
  hear(model, kWestOfIt, 20.0);
  expect({0.2870485, 0.1741037, 0.0388478});  // 0.39894 / (2 (0.39894 + 0.24197 + 0.05399)) and so on
}

TEST_F(OblongTest, WeighsTheRowsFromTheSouthAsItWeighsTheColumnsFromTheWest) {
  belief->start(model);
  hear(model, at(-3'500, 4'500), 20.0);  // 4 km from the nearest cell, which is one range step; 5 km to 5.8 km from the others, two
  for (std::size_t i = 0; i < 6; ++i) {
    const double expected = i == 1 ? 0.2479757 : 0.1504049;  // 0.39894 and 0.24197, over 0.39894 + 5 0.24197
    EXPECT_NEAR(double{belief->probability(model, i / 3, i % 3)}, expected, 1e-6) << i;
  }
}

TEST_F(OblongTest, SpreadsWhatItForgetsEvenlyAfterEveryLook) {
  model.forgotten_share = 0.3F;
  belief->start(model);
  hear(model, kWestOfIt, 20.0);
  expect({0.2509339, 0.1718726, 0.0771935});  // 0.7 of what it was without, and 0.3 / 6
  hear(model, kWestOfIt, 20.0);
  expect({0.2902090, 0.1497905, 0.0600005});  // the same again, from there
}

TEST_F(OblongTest, LearnsFromFaintnessWhatPausesAndOutliersLeaveOfIt) {
  model.silence_share = 0.2F;
  model.outlier_share = 0.1F;
  belief->start(model);
  hear_nothing(model, kWestOfIt, 20.0);
  expect({0.1255552, 0.1769843, 0.1974606});  // as 0.2 + 0.8 (0.9 p + 0.05) for p of 0.5, 0.84134, 0.97725
}

TEST_F(OblongTest, LearnsFromASoundWhatOutliersLeaveOfIt) {
  model.silence_share = 0.2F;
  model.outlier_share = 0.1F;
  belief->start(model);
  hear(model, kWestOfIt, 20.0);
  expect({0.2835445, 0.1738872, 0.0425683});  // as 0.9 d / 5 dB + 0.1 / 80 dB for d of 0.39894, 0.24197, 0.05399
}

TEST_F(OblongTest, WeighsHypothesesByTheirPriorsAndWhatTheyExplain) {
  EXPECT_EQ(model.hypotheses.push_back({.level_offset_db = 5.0F, .spread_db = 5.0F, .prior = 1.0F}), Status::kOk);
  belief->start(model);
  EXPECT_FLOAT_EQ(belief->probability(model, 1, 2), 1.0F / 6.0F);
  hear(model, kWestOfIt, 20.0);                                          // were the source 5 dB louder: -1, 0 and 1 standard deviations
  EXPECT_NEAR(belief->probability_of_hypothesis(1), 0.2975081F, 1e-6F);  // 0.25 (2 0.24197 + 0.39894), of that and 0.75 0.69490
  expect({0.2424181, 0.1895229, 0.0680592});
}

/// Where every look meets a pause, faintness teaches nothing but where the vehicle has been: a sixth of the two cells about it remains, as
/// (0 - 1 km) / 3 km + 1/2. A sound cannot be, so that all is begun anew.
TEST_F(OblongTest, BeginsAnewWhenItHearsWhatCannotBe) {
  EXPECT_EQ(model.hypotheses.push_back({.level_offset_db = 5.0F, .spread_db = 5.0F, .prior = 1.0F}), Status::kOk);
  model.silence_share = 1.0F;
  belief->start(model);
  EXPECT_FLOAT_EQ(belief->probability_of_hypothesis(0), 0.75F);
  for (int time = 0; time < 2; ++time) {
    hear_nothing(model, at(1'000, 1'500), 20.0);
    expect({1.0 / 26.0, 6.0 / 26.0, 6.0 / 26.0});
    hear(model, kWestOfIt, 20.0);
    EXPECT_FLOAT_EQ(belief->probability_of_hypothesis(0), 0.75F);
    expect({1.0 / 6.0, 1.0 / 6.0, 1.0 / 6.0});
  }
}

TEST_F(OblongTest, ForgetsWhichHypothesisExplainedWhatItHeard) {
  EXPECT_EQ(model.hypotheses.push_back({.level_offset_db = 5.0F, .spread_db = 5.0F, .prior = 1.0F}), Status::kOk);
  model.forgotten_share = 0.5F;
  belief->start(model);
  hear(model, kWestOfIt, 20.0);
  EXPECT_NEAR(belief->probability_of_hypothesis(0), 0.5F * 0.7024919F + 0.5F * 0.75F, 1e-6F);
}

/// Cells of 250 m x 1000 m in a column; likelihoods every 250 m, smoothed over the 500 m to either side.
class ColumnTest : public BeliefTest {
 protected:
  ColumnTest() {
    EXPECT_EQ(model.hypotheses.push_back({.level_offset_db = 0.0F, .spread_db = 1.0F, .prior = 1.0F}), Status::kOk);
    model.range_step = Meters{250};
  }
  /// A source that is heard at 20 dB can be at that many range steps, and at no other.
  void model_the_sound_at(std::size_t range, std::size_t ranges) {
    for (std::size_t i = 0; i < ranges; ++i) EXPECT_EQ(model.snr_db.push_back(i == range ? 20.0F : 100.0F), Status::kOk);
  }
  void expect(std::array<double, 8> shares) const {
    const double sum = std::accumulate(shares.begin(), shares.end(), 0.0);
    for (std::size_t i = 0; i < 8; ++i) EXPECT_NEAR(double{belief->probability(model, i, 0)}, shares[i] / sum, 1e-6) << i;
  }

  static constexpr NorthEast kSouthOfIt{.north = Meters{-1'875}, .east = Meters{500}};  // 8 to 15 range steps from the cells
  static constexpr NorthEast kInTheFirst{.north = Meters{125}, .east = Meters{500}};    // 0 to 7
  BeliefModel model = bare_model(at(2'000, 1'000), 8, 1);
};

TEST_F(ColumnTest, TakesARangeForOneWithinHalfACellOfIt) {
  model_the_sound_at(10, 20);
  belief->start(model);
  hear(model, kSouthOfIt, 20.0);
  expect({1, 1, 1, 1, 1, 0, 0, 0});  // 8 to 12
}

TEST_F(ColumnTest, SmoothsOverWholeRangeStepsOnly) {
  model.area_size.east = Meters{995};  // half of it is 1.99 range steps
  model_the_sound_at(10, 20);
  belief->start(model);
  hear(model, at(-1'875, 497.5), 20.0);
  expect({0, 1, 1, 1, 0, 0, 0, 0});
}

TEST_F(ColumnTest, HoldsTheLastRangesLikelihoodBeyondIt) {
  model_the_sound_at(13, 14);
  belief->start(model);
  hear(model, kSouthOfIt, 20.0);
  expect({0, 0, 0, 1, 2, 3, 3, 3});  // of five samples about 11 one is that at 13; about 13 it and two held; 14 and 15 are taken for 13
}

TEST_F(ColumnTest, HoldsTheFirstRangesLikelihoodBeforeIt) {
  model_the_sound_at(0, 14);
  model.step_length = Meters{1};
  belief->start(model);
  hear(model, kInTheFirst, 20.0);
  // Three, two and one samples of five, each by the share of a cell of 1000 m that lies further than 1 m away.
  expect({3 * 0.499, 2 * 0.749, 1 * 0.999, 0, 0, 0, 0, 0});
}

TEST_F(ColumnTest, SmoothsOverNoMoreThanAllItsRanges) {
  model_the_sound_at(0, 2);
  model.step_length = Meters{1};
  belief->start(model);
  hear(model, kInTheFirst, 20.0);
  // Two of the three samples about the first, one of those about the second. Whatever is beyond is taken for the second, at 250 m.
  expect({2 * 0.499, 0.749, 0.749, 0.749, 0.749, 0.749, 0.749, 0.749});
}

TEST_F(ColumnTest, RulesOutTheShareOfACellThatLiesWithinAStep) {
  for (std::size_t i = 0; i < 14; ++i) EXPECT_EQ(model.snr_db.push_back(20.0F), Status::kOk);
  model.step_length = Meters{500};
  belief->start(model);
  hear(model, kInTheFirst, 20.0);
  expect({0.001, 0.25, 0.5, 0.75, 1, 1, 1, 1});  // a thousandth of the vehicle's own remains
}

/// Tables in steps of 1 km, and a source that is taken to be 30 km east of the vehicle: of a step of 1.499 km the tables have one
/// of 1 km, of one of 400 m too. D is 1/2 everywhere and steps cost nothing else, so that a kilometre more of way costs 1/2.
TEST_F(BeliefTest, TakesAStepForTheNearestWholeNumberOfRangeStepsAndNoneForLessThanOne) {
  for (const double step_km : {1.499, 0.4}) {
    BeliefModel model = bare_model(at(20'000, 40'000), 2, 2);
    model.range_step = Meters{1'000};
    model.step_length = Meters{1'000 * step_km};
    model.costs = {.step = 0.0F, .reach = 1.0F, .edge = 0.0F};
    EXPECT_EQ(model.hypotheses.push_back({}), Status::kOk);
    for (std::size_t i = 0; i < 50; ++i) EXPECT_EQ(model.snr_db.push_back(10.0F), Status::kOk);  // the threshold
    belief->start(model);
    hear(model, at(10'000, -10'000), 10.0);
    EXPECT_EQ(belief->outlook(kEast).regret, 0.0F);
    EXPECT_NEAR(belief->outlook(kWest).regret, step_km, 1e-4) << step_km;  // twice a step more of way, at 1/2
  }
}

/// Two hypotheses of 3 : 1, -5 dB and +5 dB about the threshold, that explain what is heard equally well. Detected, a standard deviation
/// below and above it, in 0.158655 and 0.841345 of the calls, and a fifth of the looks meets a pause: D = 0.8 (0.75 0.158655 + 0.25
/// 0.841345) = 0.263462, at every range. Four cells make one block, so that the source is taken to be in the middle, 30 km east of the
/// vehicle.
TEST_F(BeliefTest, CostsASearchItsStepsAndThoseOfThemWithoutADetection) {
  BeliefModel model = bare_model(at(20'000, 40'000), 2, 2);
  model.range_step = Meters{1'000};
  model.step_length = Meters{3'000};
  model.detection_threshold = Decibels{20.0};
  model.silence_share = 0.2F;
  model.costs = {.step = 256.0F, .log_step_discount = -0.69314718F, .reach = 1.0F, .edge = 0.0F};  // each step half of the one before
  EXPECT_EQ(model.hypotheses.push_back({.level_offset_db = 0.0F, .spread_db = 5.0F, .prior = 3.0F}), Status::kOk);
  EXPECT_EQ(model.hypotheses.push_back({.level_offset_db = 10.0F, .spread_db = 5.0F, .prior = 1.0F}), Status::kOk);
  for (std::size_t i = 0; i < 50; ++i) EXPECT_EQ(model.snr_db.push_back(15.0F), Status::kOk);
  belief->start(model);
  hear(model, at(10'000, -10'000), 20.0);
  for (std::size_t action = 0; action < 4; ++action) EXPECT_NEAR(belief->outlook(action).detected, 0.2634621F, 1e-5F);  // as the table
  // 8 steps and one at the source from the end of a step east, 10 and one from that of a step west: 2 (1 - D) more without a detection,
  // and 256 (1/2^8 + 1/2^9) for the ninth and the tenth.
  EXPECT_EQ(belief->outlook(kEast).regret, 0.0F);
  EXPECT_NEAR(belief->outlook(kWest).regret, 2.0F * 0.7365379F + 1.5F, 1e-4F);
  // From the end of a step north it is sqrt(30^2 + 3^2) = 30.1496 km, 1.04988 steps more; linear between 30 km and 31 km.
  EXPECT_NEAR(belief->outlook(kNorth).regret, 1.804141F, 1e-4F);
}

/// A step is as likely to be silent as where it begins. Tables in steps of 2 km, as long as a step of the vehicle; a source 30 km east of
/// it. Detections are certain up to 26 km, every second at 28 km, and none beyond: from the end of a step east, 28 km, half a step is
/// silent; from that of a step west, 32 km, two more.
TEST_F(BeliefTest, CostsAStepWhatItsBeginningLeavesUnheard) {
  BeliefModel model = bare_model(at(2'000, 2'000), 2, 2);
  model.range_step = Meters{2'000};
  model.step_length = Meters{2'000};
  model.detection_threshold = Decibels{10.0};
  model.costs = {.step = 0.0F, .reach = 1.0F, .edge = 0.0F};
  EXPECT_EQ(model.hypotheses.push_back({.level_offset_db = 0.0F, .spread_db = 1.0F, .prior = 1.0F}), Status::kOk);
  for (int i = 0; i < 50; ++i) {
    const float beyond_db = i < 14 ? 20.0F : 0.0F;
    EXPECT_EQ(model.snr_db.push_back(i == 14 ? 10.0F : beyond_db), Status::kOk);
  }
  belief->start(model);
  hear(model, at(1'000, -29'000), 0.0);  // all four cells are as far away, to a step of the tables
  EXPECT_EQ(belief->outlook(kEast).regret, 0.0F);
  EXPECT_NEAR(belief->outlook(kWest).regret, 2.0F, 1e-4F);
}

TEST_F(BeliefTest, HoldsTheLargestModelThereIsRoomFor) {
  BeliefModel model = bare_model(at(25'000, 25'000), 50, 50);
  while (model.actions.push_back({1, 0}) == Status::kOk) {
  }
  while (model.hypotheses.push_back({}) == Status::kOk) {
  }
  while (model.snr_db.push_back(10.0F) == Status::kOk) {
  }
  model.forgotten_share = 0.5F;
  model.range_step = Meters{1'000};  // nothing is smoothed
  belief->start(model);
  for (int look = 0; look < 2; ++look) hear(model, at(-20'000, 12'500), 10.0);  // as loud everywhere: nothing is learned
  for (std::size_t i = 0; i < 2'500; ++i)
    ASSERT_NEAR(belief->probability(model, i / 50, i % 50), 4e-4, 1e-8) << i;  // a sum of 10 000 floats
  for (std::size_t h = 0; h < 4; ++h) EXPECT_NEAR(belief->probability_of_hypothesis(h), 0.25F, 1e-6F);
  for (std::size_t action = 0; action < 32; ++action) EXPECT_NEAR(belief->outlook(action).detected, 0.5F, 1e-5F) << action;
}

}  // namespace
}  // namespace earshot::policy
