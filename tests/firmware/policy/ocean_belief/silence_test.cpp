#include "firmware/policy/ocean_belief/silence.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <memory>
#include <numbers>

#include "tests/firmware/policy/ocean_belief/ocean_belief_rig.hpp"

namespace earshot::policy {
namespace {

constexpr Reception kNothing{.snr = Decibels{3.0}, .too_faint = true};

double normal_above(double least, double mean) {
  return 0.5 * std::erfc((least - mean) / 4.0 / std::numbers::sqrt2);
}

class SilenceTest : public testing::Test {
 protected:
  SilenceTest() { silence.start(); }
  void listen(const Reception& reception, int measurements = 1, float expected = 0.0F) {
    for (int i = 0; i < measurements; ++i) take_in(at(5'000, 5'000), reception, expected);
  }
  void take_in(NorthEast place, const Reception& reception, float expected) {
    silence.take_in(model, place, reception, expected);
    if (silence.is_behind()) silence.catch_up(model, tables);
  }
  [[nodiscard]] double against_tables() const { return double{silence.against_tables_bits()}; }

  BeliefModel model = small_model();
  OceanTables tables = no_tables(kSmallRanges);
  Silence silence;
};

/// As loud everywhere, so that level and pauses decide alone. @param heard  mean probability of each, of what is heard of a level
template <class Heard>
double written_out(int measurements, Heard heard) {
  constexpr std::array<double, 7> kLevels{0.07, 0.13, 0.19, 0.22, 0.19, 0.13, 0.07};  // -9, -6 ... 9 dB
  constexpr std::array<double, 4> kPauses{0.85, 0.07, 0.05, 0.03};                    // 0, 25, 50, 75 % of the measurements
  double sum = 0.0;
  for (std::size_t l = 0; l < kLevels.size(); ++l) {
    for (std::size_t q = 0; q < kPauses.size(); ++q) {
      const double sounding = 1.0 - 0.25 * static_cast<double>(q);
      const double missed = std::max(1.0 - sounding * heard(-9.0 + 3.0 * static_cast<double>(l)), 1.0 / 64.0);
      sum += kLevels[l] * kPauses[q] * std::pow(missed, measurements);
    }
  }
  return -std::log2(sum);
}

TEST_F(SilenceTest, IsAgainstTheTablesByEverySourceThatTheyThinkPossibleAsWrittenOut) {
  add_table(tables, 1.0F, [](double) { return 9.0; });
  for (int measurements = 1; measurements <= 12; ++measurements) {
    listen(kNothing);
    // Of 1024 sources 146 have a level, give or take 11: twice that is 15 % of the fainter ones, which are what is left; 0.2 bits, and of
    // the pauses' shares another 0.1.
    EXPECT_NEAR(against_tables(), written_out(measurements, [](double level_db) { return normal_above(3.0, 9.0 + level_db); }), 0.3)
        << measurements;
  }
}

TEST_F(SilenceTest, CountsAsManySilentPlacesAsThereAreOutOfEarshot) {
  // Heard to 3 km, 4 dB about it nobody minds: of 10 km x 10 km from the middle pi 9 / 100.
  add_table(tables, 1.0F, [](double km) { return km < 3.0 ? 60.0 : -60.0; });
  listen(kNothing, 100);
  EXPECT_NEAR(against_tables(), -std::log2(1.0 - 0.09 * std::numbers::pi), 0.1);
  EXPECT_FALSE(silence.is_long()) << "however long it listens from there";
}

TEST_F(SilenceTest, WeighsOceansByTheirPrior) {
  add_table(tables, 3.0F, [](double) { return 60.0; });
  add_table(tables, 1.0F, [](double) { return -60.0; });
  listen(kNothing, 60);
  EXPECT_NEAR(against_tables(), 2.0, 0.1) << "a quarter of all that is possible is never heard";
  EXPECT_FALSE(silence.is_long());
}

TEST_F(SilenceTest, TakesWhatIsTooFaintForNoMoreThanUnderItsFloor) {
  add_table(tables, 1.0F, [](double) { return 9.0; });
  listen({.snr = Decibels{12.0}, .too_faint = true});
  const double under_12_db = written_out(1, [](double level_db) { return normal_above(12.0, 9.0 + level_db); });
  EXPECT_NEAR(against_tables(), under_12_db, 0.2);  // as above
  silence.start();
  listen({.snr = Decibels{-20.0}, .too_faint = true});
  const double under_3_db = written_out(1, [](double level_db) { return normal_above(3.0, 9.0 + level_db); });
  EXPECT_NEAR(against_tables(), under_3_db, 0.2) << "under 3 dB nothing is heard";
  silence.start();
  listen({.snr = Decibels{-20.0}});
  EXPECT_NEAR(against_tables(), under_3_db, 0.2) << "measured or not";
}

TEST_F(SilenceTest, IsNeitherLongerNorOverWhereSomethingIsHeardThatIsNoDetection) {
  add_table(tables, 1.0F, [](double) { return 9.0; });
  listen(kNothing, 5);
  const double before = against_tables();
  listen({.snr = Decibels{3.0}});
  listen({.snr = Decibels{9.9}});
  listen({.snr = Decibels{3.0}, .too_faint = true, .bearing = messages::Bearing{.direction = Radians{1.0}, .deviation = Radians{0.1}}});
  EXPECT_EQ(against_tables(), before);
  listen(kNothing);
  EXPECT_GT(against_tables(), before);
}

TEST_F(SilenceTest, IsAgainstTheBeliefByWhatItExpectedOfEachMeasurement) {
  add_table(tables, 1.0F, [](double) { return -60.0; });
  listen(kNothing, 1, 0.5F);
  EXPECT_NEAR(double{silence.against_belief_bits()}, 1.0, 0.01);
  listen({.snr = Decibels{9.9}}, 1, 0.75F);
  EXPECT_NEAR(double{silence.against_belief_bits()}, 3.0, 0.01) << "no detection is none, however near it came";
  listen(kNothing, 1, 1.0F);
  EXPECT_NEAR(double{silence.against_belief_bits()}, 7.0, 0.01) << "of one look no more than 4 bits";
  listen(kNothing, 3, 1.0F);
  EXPECT_FALSE(silence.is_long());
  listen(kNothing, 1, 1.0F);
  EXPECT_TRUE(silence.is_long()) << "23 bits";
}

TEST_F(SilenceTest, IsLongFromItsLevelOnAndOverWithADetectionOrANewSearch) {
  add_table(tables, 1.0F, [](double) { return 60.0; });
  for (int i = 0; i < 60 && !silence.is_long(); ++i) {
    EXPECT_LT(against_tables(), kLongAgainstTables_bits);
    listen(kNothing);
  }
  EXPECT_GE(against_tables(), kLongAgainstTables_bits);
  listen({.snr = Decibels{10.0}});
  EXPECT_FALSE(silence.is_long());
  EXPECT_EQ(against_tables(), 0.0);
  EXPECT_EQ(silence.against_belief_bits(), 0.0F);
  listen(kNothing, 60, 1.0F);
  ASSERT_TRUE(silence.is_long());
  silence.start();
  EXPECT_FALSE(silence.is_long());
  EXPECT_EQ(against_tables(), 0.0);
}

TEST_F(SilenceTest, HasTheSameBitsOnEveryMachine) {
  for (int k = 0; k < 8; ++k)
    add_table(tables, 1.0F, [k](double km) { return 0.5 * static_cast<double>(60 - (4 + k) * std::lround(10.0 * km) / 10); });
  for (int i = 0; i < 8; ++i) take_in(at(1'000.0 * i, 7'000), kNothing, 0.125F);
  EXPECT_EQ(silence.against_tables_bits() * 512.0F, 2156.0F);  // of x86-64, for SSE2 and for AVX2, and of aarch64
  EXPECT_EQ(silence.against_belief_bits() * 512.0F, 792.0F);
}

/// To and fro over half of an area of 10 km, where the source would be heard.
class SilenceOfABelief : public OceanBeliefRig {
 protected:
  /// @return measurements to the first after which a sweep is called for; 100 when none is
  int measurements_to_sweep(const Reception& reception) {
    belief->start(model, tables);
    for (int i = 0; i < 100; ++i) {
      belief->update(model, tables, at(2'000.0 + 1'000.0 * (i % 4), 3'000.0 + 1'000.0 * (i / 4 % 4)), reception);
      if (belief->calls_for_sweep()) return i + 1;
    }
    return 100;
  }
};

TEST_F(SilenceOfABelief, CallsForASweepWhereNothingIsHeardThoughTheTablesSaySoAndIsNoMismatch) {
  add_table(tables, 1.0F, kTwoPerKilometre);
  for (const Reception& reception : {kNothing, Reception{.snr = Decibels{-20.0}}, Reception{.snr = Decibels{-64.0}}}) {
    EXPECT_LT(measurements_to_sweep(reception), 60) << reception.snr.value;
    EXPECT_FALSE(belief->model_mismatch().is_mismatched()) << reception.snr.value;
    hear(at(3'000, 3'000), 20.0);
    EXPECT_FALSE(belief->calls_for_sweep()) << "something is heard";
  }
}

TEST_F(SilenceOfABelief, IsNoneInAnOceanThatCarriesNoFurtherThanWhereItListened) {
  add_table(tables, 1.0F, [](double km) { return km < 1.0 ? 30.0 : -60.0; });
  EXPECT_EQ(measurements_to_sweep(kNothing), 100);
}

}  // namespace
}  // namespace earshot::policy
