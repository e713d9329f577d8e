#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "policy/baselines/catalogue.hpp"
#include "policy/baselines/gradient.hpp"
#include "policy/baselines/moves.hpp"
#include "policy/baselines/oracle.hpp"
#include "policy/baselines/patterns.hpp"
#include "policy/evaluate/evaluation.hpp"
#include "sim/search/actions/compass_directions.hpp"
#include "sim/search/known_ocean.hpp"
#include "tests/firmware/place.hpp"

namespace earshot::baselines {
namespace {

constexpr std::size_t kNorth = 0;
constexpr std::size_t kNorthEast = 1;
constexpr std::size_t kEast = 2;
constexpr std::size_t kSouth = 4;
constexpr std::size_t kWest = 6;

/// 30 dB at the source, two less per kilometre: DT = 10 dB is reached 10 km away.
sonar::SnrCurve two_decibels_per_kilometer() {
  std::vector<float> snr_db;
  for (int km = 0; km <= 40; ++km) snr_db.push_back(30.0F - 2.0F * static_cast<float>(km));
  return sonar::SnrCurve(Meters{1'000.0}, snr_db);
}

policy::OceanTables told(const sonar::SnrCurve& curve) {
  policy::OceanTables tables;
  search::make_known_ocean({}, curve, tables);
  return tables;
}

class Baselines : public testing::Test {
 protected:
  sonar::SnrCurve curve = two_decibels_per_kilometer();
  policy::OceanTables oceans = told(curve);
  PriorKnowledge prior{.settings = {}, .actions = search::compass_directions(8), .snr = curve, .oceans = oceans};
};

DecisionInput input_at(NorthEast position, NorthEast source, Decibels snr = Decibels{0.0}) {
  return {.position = position, .reception = {.snr = snr}, .vehicle = position, .source = source};
}

/// Where a searcher goes in so many steps when it always hears the same.
std::vector<NorthEast> track(Searcher& searcher, const PriorKnowledge& prior, NorthEast from, int steps) {
  std::vector<NorthEast> places{from};
  searcher.begin(Pcg32(3));
  for (int i = 0; i < steps; ++i) places.push_back(end_of(prior, places.back(), searcher.choose(input_at(places.back(), {}))));
  return places;
}

TEST_F(Baselines, OracleGoesTheWayThatEndsNearestToTheSource) {
  Oracle oracle(prior, Border::kIgnored);
  oracle.begin(Pcg32(1));
  EXPECT_EQ(oracle.choose(input_at(at(5'000, 5'000), at(20'000, 6'000))), kNorth);
  EXPECT_EQ(oracle.choose(input_at(at(5'000, 5'000), at(20'000, 18'000))), kNorthEast);
  EXPECT_EQ(oracle.choose(input_at(at(5'000, 5'000), at(5'500, 300))), kWest);
}

TEST_F(Baselines, OracleThatLooksAheadGoesAlongTheBorderWhereTheOtherGoesIntoIt) {
  Oracle heedless(prior, Border::kIgnored);
  Oracle wary(prior, Border::kSeenOneStepAhead);
  const DecisionInput beside_the_border = input_at(at(1'200, 5'000), at(100, 20'000));
  EXPECT_EQ(heedless.choose(input_at(at(1'200, 5'000), at(100, 6'000))), 3U);  // south-east, into it
  EXPECT_EQ(wary.choose(beside_the_border), kEast);
}

TEST_F(Baselines, OracleGoesByTheTruthAndNotByNavigation) {
  Oracle oracle(prior, Border::kIgnored);
  DecisionInput input = input_at(at(5'000, 5'000), at(20'000, 5'000));
  input.position = at(24'000, 5'000);  // navigation believes the source to be behind
  EXPECT_EQ(oracle.choose(input), kNorth);
}

TEST_F(Baselines, RandomWalkTakesEveryActionButNeverStepsIntoTheBorder) {
  RandomWalk walk(prior);
  std::array<int, 8> taken{};
  const Rectangle inside = search::inside_border(prior.settings);
  walk.begin(Pcg32(3));
  NorthEast place = at(12'000, 12'000);
  for (int i = 0; i < 8'000; ++i) {
    const std::size_t action = walk.choose(input_at(place, {}));
    ++taken[action];
    place = end_of(prior, place, action);
    ASSERT_TRUE(inside.contains(place));
  }
  for (const int count : taken) EXPECT_GT(count, 800);  // a thousand each, fewer at the border
}

TEST_F(Baselines, AssuredDetectionRangeIsWhereTheSnrFirstFallsBelowTheThreshold) {
  EXPECT_EQ(assured_detection_range(prior), Meters{10'000.0});  // 10 dB at 10 km still counts as heard
}

TEST_F(Baselines, LawnMowerLeavesNoPlaceInsideTheBorderFurtherThanHalfATrackSpacingAndTheCornersItCuts) {
  const sonar::SnrCurve short_range(Meters{1'000.0}, {20.0F, 15.0F, 12.0F, 5.0F});  // heard up to 2 km, tracks 4 km apart at most
  const PriorKnowledge near{.settings = {}, .actions = prior.actions, .snr = short_range, .oceans = oceans};
  LawnMower mower(near);
  const std::vector<NorthEast> places = track(mower, near, at(3'000, 3'000), 170);
  const Rectangle inside = search::inside_border(near.settings);
  for (double north_m = 1'000; north_m <= 24'000; north_m += 1'000) {
    for (double east_m = 1'000; east_m <= 24'000; east_m += 1'000) {
      const bool near_enough =
          std::ranges::any_of(places, [&](NorthEast p) { return range_between(p, at(north_m, east_m)).value < 3'200; });
      EXPECT_TRUE(near_enough) << north_m << " " << east_m;  // half of 23 km / 6 tracks = 1.92 km, and 1.25 km of a corner
    }
  }
  for (const NorthEast place : places) EXPECT_TRUE(inside.contains(place));
}

TEST_F(Baselines, SweepBeginsAnewInEverySearchFromItsNearestCornerAndKeepsOutOfTheBorder) {
  SweepSearch sweep(prior);
  const Rectangle inside = search::inside_border(prior.settings);
  for (const NorthEast from : {at(4'000, 22'000), at(20'000, 3'000)}) {
    const std::vector<NorthEast> places = track(sweep, prior, from, 150);
    const NorthEast corner = from.north.value < 12'500 ? at(1'000, 24'000) : at(24'000, 1'000);
    // 3.6 and 4.1 km away: within half a step of it, or as near as steps that keep out of the border come, in five.
    EXPECT_TRUE(std::any_of(places.begin(), places.begin() + 6, [&](NorthEast p) { return range_between(p, corner).value < 1'000; }));
    for (const NorthEast place : places) EXPECT_TRUE(inside.contains(place));
  }
}

TEST_F(Baselines, ExpandingSquareSpiralsInLegsThatGrowByTwoSteps) {
  ExpandingSquare square(prior);
  square.begin(Pcg32(1));
  std::vector<std::size_t> actions;
  for (int i = 0; i < 16; ++i) actions.push_back(square.choose(input_at(at(12'000, 12'000), {})));
  EXPECT_EQ(actions, (std::vector<std::size_t>{kNorth, kNorth, kEast, kEast, kSouth, kSouth, kSouth, kSouth, kWest, kWest, kWest, kWest,
                                               kNorth, kNorth, kNorth, kNorth}));
}

TEST_F(Baselines, ExpandingSquareTurnsAtTheBorder) {
  ExpandingSquare square(prior);
  const Rectangle inside = search::inside_border(prior.settings);
  for (const NorthEast place : track(square, prior, at(22'500, 20'000), 100)) EXPECT_TRUE(inside.contains(place));
}

TEST_F(Baselines, GradientClimbGoesOnWhileItGrowsLouderAndTurnsWhenItGrowsFainter) {
  GradientClimb climb(prior);
  climb.begin(Pcg32(3));
  const NorthEast place = at(12'000, 12'000);
  const std::size_t first = climb.choose(input_at(place, {}, Decibels{5.0}));
  EXPECT_EQ(climb.choose(input_at(place, {}, Decibels{6.0})), first);
  EXPECT_EQ(climb.choose(input_at(place, {}, Decibels{7.0})), first);
  const auto from_first = [first](std::size_t eighths) { return (first + eighths) % 8; };
  EXPECT_EQ(climb.choose(input_at(place, {}, Decibels{4.0})), from_first(2));
  EXPECT_EQ(climb.choose(input_at(place, {}, Decibels{3.0})), from_first(6));  // the other side
  EXPECT_EQ(climb.choose(input_at(place, {}, Decibels{2.0})), from_first(3));
  EXPECT_EQ(climb.choose(input_at(place, {}, Decibels{1.0})), from_first(5));
  EXPECT_EQ(climb.choose(input_at(place, {}, Decibels{4.5})), from_first(5));  // louder: goes on
  EXPECT_EQ(climb.choose(input_at(place, {}, Decibels{4.0})), from_first(7));  // a quarter turn from there
}

TEST_F(Baselines, GradientClimbFindsASourceWhoseSnrFallsEverywhereWithRange) {
  search::SearchSettings settings;
  settings.placement = search::SourcePlacement::kChanging;
  settings.start_region = search::inside_border(settings);
  const search::World world(settings, curve);
  GradientClimb climb(prior);
  int found = 0;
  for (const evaluate::Flight& flight : evaluate::fly(climb, world, {.end = 200}, 1))
    found += flight.record.end == search::EpisodeEnd::kFound ? 1 : 0;
  EXPECT_GT(found, 160);  // some sources lie in the border, which it does not enter
}

TEST_F(Baselines, EveryNameMakesASearcherThatSearchesTheSameWayAgain) {
  search::SearchSettings settings;
  settings.placement = search::SourcePlacement::kChanging;
  const search::World world(settings, curve);
  for (const Entry& entry : catalogue()) {
    const auto searcher = make_baseline(entry.name, prior);
    ASSERT_NE(searcher, nullptr) << entry.name;
    const auto once = evaluate::fly(*searcher, world, {.end = 3}, 5);
    const auto again = evaluate::fly(*searcher, world, {.end = 3}, 5);
    for (std::size_t i = 0; i < once.size(); ++i) EXPECT_EQ(once[i].record.reward, again[i].record.reward) << entry.name;
  }
  EXPECT_EQ(make_baseline("swordfish", prior), nullptr);
}

}  // namespace
}  // namespace earshot::baselines
