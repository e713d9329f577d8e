#include "firmware/guidance/sweep.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include "firmware/core/random.hpp"
#include "tests/firmware/emulated.hpp"
#include "tests/firmware/place.hpp"

namespace earshot::guidance {
namespace {

constexpr std::uint32_t kCornersOfTheSquare = 26;
const SweepPlan kSquare{.area = {at(0, 0), at(25'000, 25'000)}, .margin = Meters{1'000.0}, .step_length = Meters{1'000.0}};
const Rectangle kInside = kSquare.area.moved_in(kSquare.margin);

std::vector<UnitNorthEast> compass(int count) {
  std::vector<UnitNorthEast> actions;
  for (int i = 0; i < count; ++i) {
    const double bearing = 2.0 * std::numbers::pi * i / count;
    actions.push_back({std::cos(bearing), std::sin(bearing)});
  }
  return actions;
}

const std::vector<UnitNorthEast> kEight{
    {1, 0},  {std::numbers::sqrt2 / 2, std::numbers::sqrt2 / 2},   {0, 1},  {-std::numbers::sqrt2 / 2, std::numbers::sqrt2 / 2},
    {-1, 0}, {-std::numbers::sqrt2 / 2, -std::numbers::sqrt2 / 2}, {0, -1}, {std::numbers::sqrt2 / 2, -std::numbers::sqrt2 / 2}};

NorthEast end_of(NorthEast from, const UnitNorthEast& action) {
  return from + kSquare.step_length * action;
}

/// How much of the square lies within a step length of a place, a point every 100 m.
double share_near(const std::vector<NorthEast>& places) {
  std::vector<bool> is_near(250 * 250);
  for (const NorthEast p : places) {
    for (int n = 0; n < 250; ++n) {
      const double north = 100.0 * n + 50.0 - p.north.value;
      for (int e = 0; std::fabs(north) <= 1'000.0 && e < 250; ++e) {
        const double east = 100.0 * e + 50.0 - p.east.value;
        if (north * north + east * east <= 1e6) is_near[static_cast<std::size_t>(250 * n + e)] = true;
      }
    }
  }
  return static_cast<double>(std::ranges::count(is_near, true)) / (250.0 * 250.0);
}

/// From the corner to start with, by whatever `move` makes of a step, until every corner is reached or so many steps are taken.
template <class Move>
std::vector<NorthEast> flown(Sweep& sweep, NorthEast from, const std::vector<UnitNorthEast>& actions, std::size_t most, Move move) {
  std::vector<NorthEast> places{from};
  while (places.size() <= most) {
    const SweepStep step = sweep.next(places.back(), actions);
    if (sweep.corners_reached() >= kCornersOfTheSquare) break;
    places.push_back(move(places.back(), step));
  }
  return places;
}

/// By hand: 23 km between the margins are 12 gaps of 1.917 km, 13 tracks of 23 steps. Three passes take tracks 0, 3, 6, 9, 12, then 10, 7,
/// 4, 1, then 2, 5, 8, 11: ten ways of 5.75 km between them, of six steps, one of 3.83 km, of four, and one of 1.92 km, of two.
TEST(Sweep, TakesAsManyWaypointsOverASquareAsByHand) {
  Sweep sweep(kSquare, at(1'000, 1'000));
  const auto to_waypoint = [](NorthEast, const SweepStep& step) { return step.waypoint; };
  const std::vector<NorthEast> places = flown(sweep, at(1'000, 1'000), kEight, 1'000, to_waypoint);
  EXPECT_EQ(places.size() - 1, 13U * 23U + 10U * 6U + 4U + 2U);
  for (std::size_t i = 1; i < places.size(); ++i)
    EXPECT_LE(range_between(places[i - 1], places[i]).value, 1'000.0 + 1e-6) << "a step length is 1 km, and a rounding";
  // Closed form: between the tracks 12 x 2 x 23 slivers of 0.0177 km2 are further than a step length from every way-point, along two sides
  // 23 each of 0.0434, beyond the ends of the tracks at most 24 of 0.361, in the corners 4 of 0.215: 3.4 % of 625 km2 at most, and 1.9 at
  // least.
  EXPECT_GT(share_near(places), 0.966 - 0.001);  // 0.001: of the points that it is counted by
  EXPECT_LT(share_near(places), 0.981 + 0.001);
}

/// A step that comes near nothing that another comes near adds 1.913 km2 (two circles of 1 km, 1 km apart): a hundred and the start, 31.1 %
/// at most. What is lost are ways that cross, and tracks up to 0.41 km beside where they should be: eight directions know no better.
TEST(Sweep, ComesNearNearlyAsMuchInAHundredStepsOfEightDirectionsAsAnyPathCan) {
  Pcg32 random(1);
  double sum = 0.0;
  constexpr int kStarts = tests::times(100, 25);
  for (int i = 0; i < kStarts; ++i) {
    const double north_m = 1'000.0 + 23'000.0 * random.uniform_double();
    const NorthEast start = at(north_m, 1'000.0 + 23'000.0 * random.uniform_double());
    Sweep sweep(kSquare, start);
    sum += share_near(flown(sweep, start, kEight, 100, [](NorthEast from, const SweepStep& s) { return end_of(from, kEight[s.action]); }));
  }
  EXPECT_GT(sum / kStarts, 0.29);
  EXPECT_LT(sum / kStarts, 0.311);
}

class SweepBy : public testing::TestWithParam<int> {};

TEST_P(SweepBy, FourDirectionsOrMoreComesNearNearlyAllOfTheAreaAndKeepsOutOfTheMargin) {
  const std::vector<UnitNorthEast> actions = compass(GetParam());
  Pcg32 random(2);
  for (int i = 0; i < tests::times(20, 4); ++i) {
    const double north_m = 1'000.0 + 23'000.0 * random.uniform_double();
    const NorthEast start = at(north_m, 1'000.0 + 23'000.0 * random.uniform_double());
    Sweep sweep(kSquare, start);
    // 365 steps and 33 to the corner at most, and a tenth: few directions come back to a track in zigzag.
    const auto places =
        flown(sweep, start, actions, 438, [&](NorthEast from, const SweepStep& s) { return end_of(from, actions[s.action]); });
    EXPECT_GE(sweep.corners_reached(), kCornersOfTheSquare);
    EXPECT_GT(share_near(places), 0.85);  // tracks lie up to half a step beside where they should
    for (const NorthEast p : places) EXPECT_TRUE(kInside.contains(p)) << p.north.value << " " << p.east.value;
  }
}

INSTANTIATE_TEST_SUITE_P(Directions, SweepBy, testing::Values(4, 5, 7, 8, 16, 32));

TEST(Sweep, MakesForTheNearestCornerThenAlongTheLongerSide) {
  SweepPlan plan = kSquare;
  plan.area.north_east.east = Meters{15'000.0};
  Sweep along_north(plan, at(20'000, 10'000));  // nearest: the north-east corner, 24 km north and 14 km east
  // 4 km north and 4 east of there: a step towards it is (707, 707).
  SweepStep step = along_north.next(at(20'000, 10'000), kEight);
  EXPECT_NEAR(step.waypoint.north.value, 20'707.1, 0.1);
  EXPECT_NEAR(step.waypoint.east.value, 10'707.1, 0.1);
  EXPECT_EQ(step.action, 1U);
  step = along_north.next(at(24'000, 14'000), kEight);
  EXPECT_EQ(step.waypoint, at(23'000, 14'000));
  EXPECT_EQ(step.action, 4U);

  std::swap(plan.area.north_east.north, plan.area.north_east.east);
  Sweep along_east(plan, at(2'000, 2'000));
  EXPECT_EQ(along_east.next(at(1'000, 1'000), kEight).waypoint, at(1'000, 2'000));
}

TEST(Sweep, TakesTheActionThatEndsNearestToTheWaypointBackOntoTheTrack) {
  Sweep sweep(kSquare, at(1'000, 1'000));
  EXPECT_EQ(sweep.next(at(1'000, 1'000), kEight).action, 0U);
  // North along 1 km east. 0.35 km beside the track north is nearest: it ends 0.35 km off, north-west 0.46 km; at 0.5 km it is 0.5 and
  // 0.36.
  EXPECT_EQ(sweep.next(at(8'000, 1'350), kEight).waypoint, at(9'000, 1'000));
  EXPECT_EQ(sweep.next(at(8'000, 1'350), kEight).action, 0U);
  EXPECT_EQ(sweep.next(at(8'000, 1'500), kEight).action, 0U) << "north-west would end in the margin";
  EXPECT_EQ(sweep.next(at(8'000, 1'800), kEight).action, 7U);
  EXPECT_EQ(sweep.next(at(8'000, 500), kEight).action, 1U) << "out of the margin";
}

TEST(Sweep, GoesOnWhereItStopped) {
  Sweep sweep(kSquare, at(1'000, 1'000));
  for (int i = 0; i < 5; ++i) static_cast<void>(sweep.next(at(1'000.0 + 1'000.0 * i, 1'000), kEight));
  const SweepStep step = sweep.next(at(12'300, 9'000), kEight);  // flown elsewhere for a while
  EXPECT_EQ(step.waypoint, at(13'300, 1'000));
  EXPECT_EQ(sweep.corners_reached(), 1U);
}

/// Three tracks, north, south and north again, to the north-east corner; from there the first of the tracks across goes west.
TEST(Sweep, SweepsAcrossWhenItIsDone) {
  const SweepPlan small{.area = {at(0, 0), at(6'000, 6'000)}, .margin = Meters{1'000.0}, .step_length = Meters{1'000.0}};
  Sweep sweep(small, at(1'000, 1'000));
  NorthEast place = at(1'000, 1'000);
  SweepStep step = sweep.next(place, kEight);
  while (sweep.corners_reached() < 6) {
    place = step.waypoint;
    step = sweep.next(place, kEight);
  }
  EXPECT_EQ(place, at(5'000, 5'000));
  EXPECT_EQ(sweep.corners_reached(), 7U) << "it stands on the first corner of the tracks across";
  EXPECT_EQ(step.waypoint, at(5'000, 4'000));
  EXPECT_EQ(step.action, 6U);
}

TEST(Sweep, OfAnAreaThatTheMarginFillsStaysInItsMiddle) {
  for (const double side_m : {1.0, 1'500.0, 2'000.0}) {
    const SweepPlan tiny{.area = {at(0, 0), at(side_m, side_m)}, .margin = Meters{1'000.0}, .step_length = Meters{1'000.0}};
    const NorthEast middle = at(0.5 * side_m, 0.5 * side_m);
    Sweep sweep(tiny, middle);
    for (int i = 0; i < 20; ++i) EXPECT_EQ(sweep.next(middle, kEight).waypoint, middle) << side_m;
  }
}

}  // namespace
}  // namespace earshot::guidance
