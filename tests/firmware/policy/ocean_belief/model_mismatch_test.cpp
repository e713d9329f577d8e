#include "firmware/policy/ocean_belief/model_mismatch.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

#include "tests/firmware/policy/ocean_belief/ocean_belief_rig.hpp"

namespace earshot::policy {
namespace {

Reception heard(double snr_db) {
  return {.snr = Decibels{snr_db}};
}

Reception too_faint(double floor_db) {
  return {.snr = Decibels{floor_db}, .too_faint = true};
}

/// log2 of how likely that is to whoever knows nothing: every level and spread, measurement by measurement, written out, 208 / 256 of each
/// counting.
double log_known_nothing(const std::vector<Reception>& measurements) {
  double sum = 0.0;
  for (int level = 0; level <= 40; level += 5) {
    for (const double spread : {2.0, 5.0}) {
      double product = 1.0 / 18.0;
      for (const Reception& measurement : measurements) {
        const double z = (measurement.snr.value - level) / spread;
        const double density = std::exp(-0.5 * z * z) / (spread * std::sqrt(2.0 * std::numbers::pi));
        product *= std::pow(measurement.too_faint ? 0.05 : 0.95 * (0.98 * density + 0.02 / 80.0), 0.8125);
      }
      sum += product;
    }
  }
  return std::log2(sum);
}

TEST(LogOfSum, IsThatOfTheClosedForm) {
  EXPECT_NEAR(log_of_sum(std::array{-5'120}), -5'120, 1) << "of one it is that one";
  EXPECT_NEAR(log_of_sum(std::array{1'024, 1'024}), 1'536, 1) << "4 + 4 = 8";
  EXPECT_NEAR(log_of_sum(std::array{-512'000, 0, 512, -1'024}), 512.0 * std::log2(3.25), 1);
  EXPECT_NEAR(log_of_sum(std::array{-900'000, -900'512}), -900'000 + 512.0 * std::log2(1.5), 1);
}

class ModelMismatchTest : public testing::Test {
 protected:
  ModelMismatchTest() { mismatch.start(); }
  double bits_after(const std::vector<Reception>& measurements, int explained = 0) {
    mismatch.start();
    for (const Reception& measurement : measurements) mismatch.take_in(measurement, explained);
    return double{mismatch.bits()};
  }
  ModelMismatch mismatch;
};

TEST_F(ModelMismatchTest, IsNoneBeforeAnythingIsHeard) {
  EXPECT_EQ(mismatch.bits(), 0.0F);
  EXPECT_FALSE(mismatch.is_mismatched());
}

TEST_F(ModelMismatchTest, ComparesWithKnowingNothingAsWrittenOut) {
  // A measurement rounds by half of 1/512; the density of the normal table is 5e-5 off, a thousandth of that of 5 dB within one deviation.
  const std::vector<Reception> alike{heard(27.0), heard(31.0), heard(26.0), heard(22.5), heard(33.0), heard(28.0)};
  EXPECT_NEAR(bits_after(alike), log_known_nothing(alike), 0.05);
  std::vector<Reception> first;
  for (const Reception& measurement : alike) {
    first.push_back(measurement);
    EXPECT_NEAR(bits_after(first), log_known_nothing(first), 0.05) << first.size();
  }
  const std::vector<Reception> with_silence{heard(12.0), too_faint(3.0), too_faint(3.0), heard(9.0)};
  EXPECT_NEAR(bits_after(with_silence), log_known_nothing(with_silence), 0.05);
}

TEST_F(ModelMismatchTest, IsTheHigherTheLessIsExplained) {
  const std::vector<Reception> measurements{heard(20.0), heard(21.0)};
  EXPECT_NEAR(bits_after(measurements, -10 * 512) - bits_after(measurements, -2 * 512), 8.0, 1e-6);
}

TEST_F(ModelMismatchTest, IsNotRaisedByWhatIsTooFaintToMeasure) {
  const std::vector<Reception> silence(100, too_faint(3.0));
  EXPECT_NEAR(bits_after(silence, 0), -81.25 * std::log2(20.0), 0.2);
}

TEST_F(ModelMismatchTest, FollowsALevelThatChanges) {
  std::vector<Reception> measurements(40, heard(5.0));
  measurements.insert(measurements.end(), 20, heard(35.0));
  const double before = bits_after(measurements);
  measurements.insert(measurements.end(), 20, heard(35.0));
  // 0.8125 of log2 of 0.95 * 0.98 of the density at the middle of 2 dB: -1.97 bits a measurement; a product of 40 measurements 15
  // deviations off would take 132 times 20.
  EXPECT_NEAR((bits_after(measurements) - before) / 20.0, 0.8125 * std::log2(0.95 * 0.98 / (2.0 * std::sqrt(2.0 * std::numbers::pi))),
              0.02);
}

TEST_F(ModelMismatchTest, TakesABearingForOneMoreLikelihoodThatIsExplained) {
  const double without = bits_after({heard(20.0)}, -1'000);
  mismatch.start();
  mismatch.take_in_bearing(3 * 512);
  mismatch.take_in(heard(20.0), -1'000);
  EXPECT_NEAR(double{mismatch.bits()}, without - 3.0, 1e-6);
}

TEST_F(ModelMismatchTest, LastsFromTheLevelOnUntilTheNextSearch) {
  const auto explained_by = [&](float bits) {  // explained so badly that the mismatch is as high
    mismatch.start();
    mismatch.take_in(heard(20.0), 0);
    const auto known_nothing = static_cast<int>(512.0F * mismatch.bits());
    mismatch.start();
    mismatch.take_in(heard(20.0), known_nothing - static_cast<int>(512.0F * bits));
  };
  explained_by(kMismatchLevel_bits - 1.0F / 512.0F);
  EXPECT_FALSE(mismatch.is_mismatched());
  explained_by(kMismatchLevel_bits);
  EXPECT_TRUE(mismatch.is_mismatched());
  EXPECT_FALSE(mismatch.calls_for_sweep());
  mismatch.take_in(heard(20.0), 0);
  EXPECT_LT(mismatch.bits(), 0.0F);
  EXPECT_TRUE(mismatch.is_mismatched()) << "what was not explained has been heard";
  mismatch.start();
  EXPECT_FALSE(mismatch.is_mismatched());
}

TEST_F(ModelMismatchTest, CallsForASweepFromAHigherLevelOn) {
  static_assert(kSweepLevel_bits > kMismatchLevel_bits);
  mismatch.start();
  mismatch.take_in(heard(20.0), 0);
  const auto at_level = static_cast<int>(512.0F * (mismatch.bits() - kSweepLevel_bits));
  mismatch.start();
  mismatch.take_in(heard(20.0), at_level + 2);
  EXPECT_FALSE(mismatch.calls_for_sweep());
  mismatch.start();
  mismatch.take_in(heard(20.0), at_level - 1);
  EXPECT_TRUE(mismatch.calls_for_sweep());
  mismatch.take_in(heard(20.0), 0);
  EXPECT_TRUE(mismatch.calls_for_sweep()) << "what was heard stays unexplained";
  mismatch.start();
  EXPECT_FALSE(mismatch.calls_for_sweep());
}

TEST(PriorPenalty, IsThatOfALouderSourceAWideSpreadAndMotion) {
  EXPECT_EQ(prior_penalty({.level = 3, .spread = 2, .silence = 3}), 0);
  EXPECT_EQ(prior_penalty({.level = 0, .spread = 0}), 0) << "a fainter source is not odd";
  EXPECT_EQ(prior_penalty({.level = 4}), 2 * 512);
  EXPECT_EQ(prior_penalty({.level = 5}), 6 * 512);
  EXPECT_EQ(prior_penalty({.level = 6}), 12 * 512);
  EXPECT_EQ(prior_penalty({.spread = 3}), 4 * 512);
  for (const std::uint8_t mobility : {std::uint8_t{1}, std::uint8_t{2}, std::uint8_t{3}})
    EXPECT_EQ(prior_penalty({.mobility = mobility}), 4 * 512);
  EXPECT_EQ(prior_penalty({.drift = {.east = -1}}), 4 * 512);
  EXPECT_EQ(prior_penalty({.drift = {.north = 2, .is_current = true}}), 4 * 512);
  EXPECT_EQ(prior_penalty({.mobility = 1, .drift = {.north = 2}}), 4 * 512) << "it moves, this way and that or always the same";
  EXPECT_EQ(prior_penalty({.level = 6, .spread = 3, .mobility = 2}), 20 * 512) << "they add up";
}

class ModelMismatchOfABelief : public OceanBeliefRig {};

/// As loud everywhere, so that a hypothesis gives a measurement the same likelihood at every place, wherever the source has drifted.
class UnlikelyExplanations : public ModelMismatchOfABelief {
 protected:
  void expect_by_hand(const std::vector<Reception>& measurements) {
    add_table(tables, 1.0F, [](double) { return 12.0; });
    belief->start(model, tables);
    for (const Reception& measurement : measurements) belief->update(model, tables, at(-3'000, 5'000), measurement);
    double explained = 0.0;
    for (std::size_t i = 0; i < OceanBelief::kHypotheses; ++i) {
      const Hypothesis& h = belief->hypothesis(i);
      Hypothesis without_drift = h;
      without_drift.drift = {};
      double p = std::exp2((log_prior(without_drift, tables) - log_prior(Drift{}) - prior_penalty(h)) / 512.0);
      for (const Reception& measurement : measurements) p *= static_cast<double>(likelihoods_by_hand(model, tables, h, measurement)[100]);
      explained += p;
    }
    EXPECT_NEAR(double{belief->model_mismatch().bits()}, log_known_nothing(measurements) - std::log2(explained), 0.05);
  }
};

TEST_F(UnlikelyExplanations, CountForLess) {
  expect_by_hand({heard(14.0), heard(19.0), heard(9.5)});
  EXPECT_EQ(retained_that_drift(), 0);
}

/// One drift of hundreds has not as high a penalty as its prior is low: the others explain nearly the same.
TEST_F(UnlikelyExplanations, AreDriftsByTheirPenaltyInPlaceOfTheirPrior) {
  expect_by_hand({heard(14.0), heard(19.0), heard(9.5), heard(12.0), heard(15.0), heard(11.0), heard(8.0), heard(16.0), heard(13.0),
                  heard(10.0), heard(12.5), heard(11.5)});
  EXPECT_GT(retained_that_drift(), 0);
}

/// A bearing explains as much as it is likelier than any other direction, on the mean over the places.
TEST_F(ModelMismatchOfABelief, TakesABearingForWhatItSaysOfThePlaces) {
  add_table(tables, 1.0F, [](double) { return 12.0; });
  const NorthEast place = at(-3'000, 5'000);
  for (const double direction : {0.0, std::numbers::pi}) {
    const auto bits = [&](const Reception& measurement) {
      belief->start(model, tables);
      belief->update(model, tables, place, measurement);
      return double{belief->model_mismatch().bits()};
    };
    Reception with = heard(12.0);
    with.bearing = messages::Bearing{.direction = Radians{direction}, .deviation = Radians{0.2}};
    double mean = 0.0;
    for (int i = 0; i < 400; ++i) {
      const double north_m = 500.0 * (i / 20 + 0.5) - place.north.value;
      const double east_m = 500.0 * (i % 20 + 0.5) - place.east.value;
      const double smear = 500.0 / std::hypot(north_m, east_m) / std::sqrt(12.0);
      mean += (0.98 * wrapped(std::atan2(east_m, north_m) - direction, std::hypot(0.2, smear)) + 0.02) / 400.0;
    }
    EXPECT_NEAR(bits(with) - bits(heard(12.0)), -std::log2(mean), 0.02) << "from the area, and from behind";
  }
}

/// What is heard along a way across the area from a source in the middle, 2 dB about an ocean's SNR of a range in km.
template <class Snr>
std::vector<float> flown(const BeliefModel& model, const OceanTables& tables, Snr snr_db, OceanBelief& belief) {
  Pcg32 random(3);
  belief.start(model, tables);
  std::vector<float> bits;
  for (int i = 0; i < 15; ++i) {
    const NorthEast place = at(600.0 * i + 500.0, i % 2 == 0 ? 1'500.0 : 9'000.0);
    double normal = -6.0;
    for (int k = 0; k < 12; ++k) normal += random.uniform_double();
    belief.update(model, tables, place, heard(snr_db(range_between(place, at(5'200, 5'300)).value / 1'000.0) + 2.0 * normal));
    bits.push_back(belief.model_mismatch().bits());
  }
  return bits;
}

TEST_F(ModelMismatchOfABelief, ComesWhereEverythingIsLouderThanInAnyOceanAndNotInOneThatIsKnown) {
  const auto known = [](double km) { return 30.0 - 6.0 * km; };
  add_table(tables, 1.0F, known);
  const std::vector<float> at_home = flown(model, tables, known, *belief);
  EXPECT_FALSE(belief->model_mismatch().is_mismatched());
  EXPECT_LT(at_home.back(), 0.0F) << "the ocean explains more than knowing nothing";
  flown(
      model, tables, [](double) { return 30.0; }, *belief);
  EXPECT_TRUE(belief->model_mismatch().is_mismatched());
  add_table(tables, 1.0F, [](double) { return 30.0; });
  flown(
      model, tables, [](double) { return 30.0; }, *belief);
  EXPECT_FALSE(belief->model_mismatch().is_mismatched()) << "once it is known";
}

TEST_F(ModelMismatchOfABelief, HasTheSameBitsOnEveryMachine) {
  for (int k = 0; k < 8; ++k)
    add_table(tables, 1.0F, [k](double km) { return 0.5 * static_cast<double>(60 - (4 + k) * std::lround(10.0 * km) / 40); });
  belief->start(model, tables);
  Pcg32 random(9);
  for (int i = 0; i < 30; ++i) {
    const double north_m = 10'000 * random.uniform_double();  // one after the other: arguments are drawn in any order
    const double east_m = 10'000 * random.uniform_double();
    belief->update(model, tables, at(north_m, east_m), {.snr = Decibels{30.0 * random.uniform_double()}, .too_faint = i % 7 == 6});
  }
  EXPECT_EQ(belief->model_mismatch().bits() * 512.0F, -8'575.0F);  // of x86-64, for SSE2 and for AVX2, and of aarch64
}

TEST_F(ModelMismatchOfABelief, IsForgottenWhenASearchStarts) {
  add_table(tables, 1.0F, [](double km) { return 30.0 - 6.0 * km; });
  flown(
      model, tables, [](double) { return 30.0; }, *belief);
  ASSERT_TRUE(belief->model_mismatch().is_mismatched());
  belief->start(model, tables);
  EXPECT_FALSE(belief->model_mismatch().is_mismatched());
  EXPECT_EQ(belief->model_mismatch().bits(), 0.0F);
}

}  // namespace
}  // namespace earshot::policy
