#include "policy/baselines/infotaxis.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "policy/baselines/moves.hpp"
#include "sim/search/actions/compass_directions.hpp"
#include "sim/search/known_ocean.hpp"
#include "tests/firmware/place.hpp"

namespace earshot::baselines {
namespace {

/// 60 dB at the source, four less per kilometre: a source that is 3 dB louder than believed seems less than a kilometre nearer.
sonar::SnrCurve four_decibels_per_kilometer() {
  std::vector<float> snr_db;
  for (int km = 0; km <= 30; ++km) snr_db.push_back(60.0F - 4.0F * static_cast<float>(km));
  return sonar::SnrCurve(Meters{1'000.0}, snr_db);
}

constexpr policy::Reception kNothing{.snr = Decibels{3.0}, .too_faint = true};

class InfotaxisTest : public testing::Test {
 protected:
  PriorKnowledge prior_with(const sonar::SnrCurve& curve) {
    search::make_known_ocean({}, curve, tables_);
    return {.settings = {}, .actions = search::compass_directions(8), .snr = curve, .oceans = tables_};
  }
  static std::size_t choice(Infotaxis& searcher, NorthEast position, policy::Reception reception) {
    return searcher.choose({.position = position, .reception = reception, .vehicle = {}, .source = {}});
  }

  policy::OceanTables tables_;
};

/// Nothing is heard anywhere, which leaves all places as likely as another, whatever the hypothesis; and nothing will be.
TEST_F(InfotaxisTest, ExpectsInSilenceThatAStepClearsItsSurroundingsOnly) {
  const sonar::SnrCurve silent(Meters{1'000.0}, {-60.0F, -60.0F});
  const PriorKnowledge prior = prior_with(silent);
  Infotaxis searcher(prior);
  searcher.begin(Pcg32(1));
  static_cast<void>(choice(searcher, at(12'500, 12'500), kNothing));
  // 625 places of a square kilometre, about 3.1 of which a circle of a kilometre covers; the mean distance from the middle of a square of
  // side s to a point of it is 0.3826 s.
  const double cleared = 3.1416;
  const double left = 1.0 - cleared / 625.0;
  const double entropy = std::log2(625.0 - cleared);
  const double expected = left * std::log2(0.3826 * 25.0 + std::exp2(entropy - 2.0) - 0.5);
  // The distance from a place a step from the middle, and the edges of the circles, are not those to 0.5 %.
  EXPECT_NEAR(searcher.expected_cost(at(13'500, 12'500)), expected, 0.03);
}

/// Three measurements on one line leave two places for the source, mirror images of each other: north of the line and south of it. Along
/// the line the next measurement tells nothing of which it is, across it it does, and comes nearer to one of them besides.
TEST_F(InfotaxisTest, LeavesALineThatDoesNotTellOneSideFromTheOther) {
  const sonar::SnrCurve curve = four_decibels_per_kilometer();
  const PriorKnowledge prior = prior_with(curve);
  Infotaxis searcher(prior);
  searcher.begin(Pcg32(1));
  const NorthEast source = at(18'500, 12'500);
  std::size_t action = 0;
  for (double east_m = 8'500; east_m <= 12'500; east_m += 1'000) {
    const NorthEast here = at(12'500, east_m);
    action = choice(searcher, here, {.snr = curve.at(range_between(here, source))});
  }
  const UnitNorthEast way = prior.actions[action];
  EXPECT_GT(std::abs(way.north), 0.5) << way.north << ", " << way.east;
  EXPECT_LT(searcher.expected_cost(at(13'500, 12'500)), searcher.expected_cost(at(12'500, 13'500)) - 0.05);
}

TEST_F(InfotaxisTest, GoesStraightToASourceWhosePlaceItKnows) {
  const sonar::SnrCurve curve = four_decibels_per_kilometer();
  const PriorKnowledge prior = prior_with(curve);
  Infotaxis searcher(prior);
  searcher.begin(Pcg32(1));
  const NorthEast source = at(18'250, 12'250);
  // Round three sides of a square, again and again: until everything fits but one place.
  std::size_t action = 0;
  for (int round = 0; round < 4; ++round) {
    for (const NorthEast here : {at(6'250, 6'250), at(6'250, 18'250), at(14'250, 18'250), at(14'250, 12'250)})
      action = choice(searcher, here, {.snr = curve.at(range_between(here, source))});
  }
  EXPECT_EQ(action, straight_toward(prior, at(14'250, 12'250), source));
  EXPECT_NEAR(searcher.expected_cost(at(15'250, 12'250)), std::log2(3.0), 0.6);  // three steps are left, and a few places
}

TEST_F(InfotaxisTest, NeverStepsOutOfTheDomainWhileItNeedNot) {
  const sonar::SnrCurve silent(Meters{1'000.0}, {-60.0F, -60.0F});
  const PriorKnowledge prior = prior_with(silent);
  Infotaxis searcher(prior);
  searcher.begin(Pcg32(1));
  for (const NorthEast corner : {at(100, 100), at(100, 24'900), at(24'900, 24'900), at(24'900, 100)}) {
    const std::size_t action = choice(searcher, corner, kNothing);
    EXPECT_TRUE(prior.settings.domain.contains(end_of(prior, corner, action))) << corner.north.value << ", " << corner.east.value;
  }
}

}  // namespace
}  // namespace earshot::baselines
