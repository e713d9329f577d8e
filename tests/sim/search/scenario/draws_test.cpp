// What a search draws of its conditions, and how evenly.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <set>
#include <vector>

#include "sim/search/episode/episode.hpp"
#include "tests/firmware/place.hpp"
#include "tests/sim/search/scenario/scenario_rig.hpp"

namespace earshot::search {
namespace {

constexpr NorthEast kVehicle = at(22'000, 10'000);

World world_of(const Conditions& conditions, const SearchSettings& settings = {}) {
  return World(settings, Soundscape({sonar::SnrCurve(Meters{1'000.0}, {18.0F})}), conditions);
}

Surroundings search_in(const World& world, std::uint64_t seed, NorthEast source = at(10'000, 10'000)) {
  Surroundings surroundings;
  surroundings.start(world, kVehicle, source, Pcg32(seed));
  return surroundings;
}

/// How often each hundredth of the compass was drawn.
using Sectors = std::array<int, 100>;
std::size_t sector_of(NorthEast way) {
  const double turns = std::atan2(way.east.value, way.north.value) / (2.0 * std::numbers::pi);
  return static_cast<std::size_t>(100.0 * (turns < 0.0 ? turns + 1.0 : turns)) % 100;
}
void expect_even(const Sectors& drawn) {  // 400 each; six standard deviations of 20
  for (std::size_t i = 0; i < drawn.size(); ++i) EXPECT_NEAR(drawn[i], 400, 120) << "hundredth " << i;
}

TEST(SearchConditions, LetSourcesSwimAnyWayAsLikelyAsAnyOther) {
  Conditions conditions;
  conditions.source_speed = MetersPerSecond{1.0};
  const World world = world_of(conditions);
  Sectors drawn{};
  for (std::uint64_t seed = 0; seed < 40'000; ++seed) {
    Surroundings search = search_in(world, seed);
    (void)search.pass(world, {}, 1'000.0);
    const NorthEast way = search.nearest_source(kVehicle) - at(10'000, 10'000);
    ASSERT_NEAR(length_of(way).value, 1'000.0, 1e-6);  // core's sine is good to 1e-12
    drawn[sector_of(way)] += 1;
  }
  expect_even(drawn);
}

TEST(SearchConditions, LetACurrentWithoutADirectionSetAnyWayAsLikelyAsAnyOther) {
  Conditions conditions;
  conditions.current = Current{.speed = MetersPerSecond{1.0}, .toward = {}};
  const World world = world_of(conditions);
  Sectors drawn{};
  for (std::uint64_t seed = 0; seed < 40'000; ++seed) drawn[sector_of(search_in(world, seed).pass(world, {}, 1'000.0))] += 1;
  expect_even(drawn);
}

TEST(SearchConditions, MirrorASourceThatWouldSwimOverAnEdge) {
  Conditions conditions;
  conditions.source_speed = MetersPerSecond{1.0};
  SearchSettings unbounded;
  unbounded.domain = {at(-1e6, -1e6), at(1e6, 1e6)};
  const World endless = world_of(conditions, unbounded);
  const World bounded = world_of(conditions);  // 25 km by 25 km
  const auto mirrored = [](double x) { return x < 0.0 ? -x : x > 25'000.0 ? 50'000.0 - x : x; };
  for (const NorthEast source : {at(200, 24'700), at(24'900, 400)}) {
    for (std::uint64_t seed = 0; seed < 200; ++seed) {
      Surroundings free = search_in(endless, seed, source);
      Surroundings held = search_in(bounded, seed, source);
      for (int step = 0; step < 3; ++step) {  // the same straight course, folded at the edges
        (void)free.pass(endless, {}, 500.0);
        (void)held.pass(bounded, {}, 500.0);
        const NorthEast straight = free.nearest_source(kVehicle);
        const NorthEast folded = held.nearest_source(kVehicle);
        ASSERT_NEAR(folded.north.value, mirrored(straight.north.value), 1e-6);  // sums of doubles near 25 000
        ASSERT_NEAR(folded.east.value, mirrored(straight.east.value), 1e-6);
      }
    }
  }
}

TEST(SearchConditions, HoldASourceAtTheFarEdgeWhenOneStepIsLongerThanTheDomain) {
  Conditions conditions;
  conditions.source_speed = MetersPerSecond{20.0};
  SearchSettings small;
  small.domain = small.start_region = {at(0, 0), at(1'500, 2'500)};
  const World world = world_of(conditions, small);
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    Surroundings search = search_in(world, seed, at(700, 700));
    for (int step = 0; step < 4; ++step) {
      (void)search.pass(world, {}, 500.0);  // 10 km
      ASSERT_TRUE(small.domain.contains(search.nearest_source(kVehicle)));
    }
  }
}

TEST(SearchConditions, ComeFromAStreamSeededByTwoNumbersOfTheSearchs) {
  Conditions conditions;
  conditions.fluctuation = Decibels{4.0};
  const World world = world_of(conditions);
  Pcg32 random(3);
  Pcg32 same(3);
  for (int search = 0; search < 3; ++search) {
    const std::uint64_t high = same.next();
    const std::uint64_t low = same.next();
    EXPECT_EQ(Surroundings::stream_from(world, random).state(), Pcg32(high * 4'294'967'296U + low).state());
  }
  std::set<double> heard_db;
  Episode episode;
  const policy::ObservationModel sees_nothing;
  for (int search = 0; search < 50; ++search) {
    episode.start(world, sees_nothing, kNoOceans, random);
    heard_db.insert(episode.snr().value);
  }
  EXPECT_EQ(heard_db.size(), 50U) << "every search draws its own";
}

TEST(SearchConditions, PutNoFurtherSourceWithinReachOfTheStart) {
  Conditions conditions;
  conditions.sources = 8;
  SearchSettings small;
  small.domain = small.start_region = {at(20'000, 8'000), at(24'000, 12'000)};  // a fifth of it lies within 1 km of its middle
  const World world = world_of(conditions, small);
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    const Arrivals arrivals = search_in(world, seed).arrivals(world, kVehicle);
    EXPECT_EQ(arrivals.size(), 8U);
    for (const Arrival& arrival : arrivals) EXPECT_GT(arrival.range, Meters{1'000.0});
  }
}

TEST(SearchConditions, FluctuateByJustAsMuchAsTheySay) {
  for (const double fluctuation_db : {0.5, 4.0}) {
    Conditions conditions;
    conditions.fluctuation = Decibels{fluctuation_db};
    const World world = world_of(conditions);
    Surroundings search = search_in(world, 1);
    constexpr int kMeasurements = 1'000'000;
    double sum = 0.0;
    double squares = 0.0;
    for (int i = 0; i < kMeasurements; ++i) {
      const double off = (search.listen(world, kVehicle).snr.value - 18.0) / fluctuation_db;
      sum += off;
      squares += off * off;
    }
    EXPECT_NEAR(sum / kMeasurements, 0.0, 0.005);      // five standard errors of 1 / sqrt(n)
    EXPECT_NEAR(squares / kMeasurements, 1.0, 0.007);  // five of sqrt(2 / n)
  }
}

TEST(SearchConditions, DriftBySmallSharesToo) {
  Conditions conditions;
  conditions.drift_m_per_sqrt_km = 0.5;
  const World world = world_of(conditions);
  double squares = 0.0;
  constexpr int kSearches = 4'000;
  for (std::uint64_t seed = 0; seed < kSearches; ++seed) {
    Surroundings search = search_in(world, seed);
    (void)search.pass(world, at(0, 4'000), 2'000.0);
    squares += search.navigation_error().east.value * search.navigation_error().east.value / kSearches;
  }
  EXPECT_NEAR(squares, 1.0, 0.12);  // (0.5 m)^2 times 4 km; five standard errors of sqrt(2 / n)
}

TEST(SearchConditions, WithoutACurrentCarryNobody) {
  Conditions conditions;
  conditions.fluctuation = Decibels{1.0};
  conditions.current = Current{.speed = MetersPerSecond{1.0}, .toward = {}};
  conditions.current.reset();
  const World world = world_of(conditions);
  EXPECT_EQ(search_in(world, 1).pass(world, at(10, 20), 1'000.0), at(10, 20));
}

TEST(SearchConditions, OfACalmWorldAreItsOneOceanAndASourceThatAlwaysCalls) {
  const World calm = world_of({});
  Surroundings search = search_in(calm, 1);
  EXPECT_EQ(search.ocean(), 0U);
  const Arrivals arrivals = search.arrivals(calm, kVehicle);
  EXPECT_TRUE(arrivals[0].has_called);
  EXPECT_EQ(arrivals[0].sung_s, 0.0);
  const World two({}, Soundscape({sonar::SnrCurve(Meters{1'000.0}, {20.0F}), sonar::SnrCurve(Meters{1'000.0}, {10.0F})}), Conditions{});
  std::set<std::size_t> oceans;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    Surroundings other = search_in(two, seed);
    oceans.insert(other.ocean());
    EXPECT_EQ(other.listen(two, kVehicle).snr, Decibels{other.ocean() == 0 ? 20.0 : 10.0}) << seed;
  }
  EXPECT_EQ(oceans, (std::set<std::size_t>{0, 1}));
}

TEST(SearchConditions, AreHeardFromTheSourceTowardsTheVehicle) {
  const SnrFan fan{.fan = {.centre = at(0, 0),
                           .bearings = 2,
                           .ranges = 2,
                           .range_step = Meters{10'000.0},
                           .depth_m = {300.0},
                           .transmission_loss_db = {70.0F, 70.0F, 80.0F, 80.0F},  // northwards and southwards of a source
                           .sea_floor_depth_m = {}},
                   .source_level = Decibels{190.0},
                   .noise_level = Decibels{90.0}};
  const World world({}, Soundscape(sonar::SnrCurve(Meters{1'000.0}, {0.0F}), {fan}), Conditions{});
  Surroundings search;
  search.start(world, at(14'000, 10'000), at(10'000, 10'000), Pcg32(1));
  EXPECT_EQ(search.listen(world, at(14'000, 10'000)).snr, Decibels{190.0 - 70.0 - 90.0});
  EXPECT_EQ(search.listen(world, at(6'000, 10'000)).snr, Decibels{190.0 - 80.0 - 90.0});
}

}  // namespace
}  // namespace earshot::search
