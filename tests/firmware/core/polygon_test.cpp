#include "firmware/core/polygon.hpp"

#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <vector>

#include "tests/firmware/place.hpp"

namespace earshot {
namespace {

using Polygon = std::vector<NorthEast>;

// North is up, east to the right:
//
//   4  A---------B
//      |         |
//   2  |   D-----C
//      |   |
//   0  F---E
//      0   2     6
const Polygon kAngle{at(4, 0), at(4, 6), at(2, 6), at(2, 2), at(0, 2), at(0, 0)};

Polygon reversed(const Polygon& polygon) {
  return {polygon.rbegin(), polygon.rend()};
}

TEST(Polygon, ContainsItsEdgesAndNoBay) {
  for (const Polygon& angle : {kAngle, reversed(kAngle)}) {
    for (const NorthEast in : {at(3, 5), at(1, 1), at(3, 1), at(2.001, 5)}) EXPECT_TRUE(contains(angle, in)) << in.north.value;
    for (const NorthEast on : {at(4, 3), at(3, 6), at(2, 4), at(1, 2), at(0, 1), at(2, 0)})
      EXPECT_TRUE(contains(angle, on)) << on.east.value;
    for (const NorthEast corner : angle) EXPECT_TRUE(contains(angle, corner));
    for (const NorthEast out : {at(1, 4), at(1.999, 4), at(5, 3), at(-1, 1), at(3, 7), at(1, -1), at(4, 7), at(2, -1), at(0, 6), at(4, -2)})
      EXPECT_FALSE(contains(angle, out)) << out.north.value << " " << out.east.value;
  }
}

TEST(Polygon, ContainsNoPlaceThatIsNotFinite) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  for (const double wrong : {kNan, kInfinity, -kInfinity}) {
    EXPECT_FALSE(contains(kAngle, at(wrong, 1)));
    EXPECT_FALSE(contains(kAngle, at(1, wrong)));
  }
}

// A diamond whose corners lie north, east, south and west of the middle: a ray to the east from the middle runs through a corner.
TEST(Polygon, CountsACornerThatTheRayRunsThroughOnce) {
  const Polygon diamond{at(2, 0), at(0, 2), at(-2, 0), at(0, -2)};
  EXPECT_TRUE(contains(diamond, at(0, 0)));
  EXPECT_TRUE(contains(diamond, at(0, -1.5)));
  EXPECT_FALSE(contains(diamond, at(0, -2.5)));
  EXPECT_FALSE(contains(diamond, at(2, -1)));
  EXPECT_FALSE(contains(diamond, at(-2, -1)));
}

TEST(PolygonCheck, AcceptsOneThatEnclosesOneArea) {
  EXPECT_TRUE(check_polygon(kAngle).is_none());
  EXPECT_TRUE(check_polygon(reversed(kAngle)).is_none());
  EXPECT_TRUE(check_polygon(Polygon{at(0, 0), at(1, 0), at(0, 1)}).is_none());
  EXPECT_TRUE(check_polygon(Polygon{at(0, 0), at(1, 0), at(2, 0), at(0, 1)}).is_none()) << "a corner on a straight line";
}

TEST(PolygonCheck, NamesWhatIsWrongAndWhere) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  const auto complaint = [](const Polygon& polygon) { return check_polygon(polygon); };
  EXPECT_EQ(complaint({at(0, 0), at(1, 0)}).fault, PolygonFault::kTooFewCorners);
  EXPECT_EQ(complaint({}).fault, PolygonFault::kTooFewCorners);
  EXPECT_EQ(complaint({at(0, 0), at(1, 0), at(0, kNan)}).fault, PolygonFault::kNotFinite);
  EXPECT_EQ(complaint({at(0, 0), at(1, 0), at(0, kNan)}).edge, 2U);
  EXPECT_EQ(complaint({at(0, 0), at(1, 0), at(1, 0), at(0, 1)}).fault, PolygonFault::kRepeatedCorner);
  EXPECT_EQ(complaint({at(0, 0), at(1, 0), at(1, 0), at(0, 1)}).edge, 1U);
  EXPECT_EQ(complaint({at(0, 0), at(1, 0), at(0, 1), at(0, 0)}).edge, 3U) << "the last corner may not be the first again";
  // A bow tie: the second edge crosses the last.
  const PolygonComplaint bow_tie = complaint({at(0, 0), at(0, 2), at(2, 0), at(2, 2)});
  EXPECT_EQ(bow_tie.fault, PolygonFault::kCrossesItself);
  EXPECT_EQ(bow_tie.edge, 1U);
  EXPECT_EQ(bow_tie.other, 3U);
}

TEST(PolygonCheck, RefusesEdgesThatTouchOrLieOnEachOther) {
  const auto fault = [](const Polygon& polygon) { return check_polygon(polygon).fault; };
  EXPECT_EQ(fault({at(0, 0), at(4, 0), at(4, 1), at(1, 2), at(4, 3), at(4, 4), at(0, 4)}), PolygonFault::kNone) << "a notch";
  EXPECT_EQ(fault({at(0, 0), at(4, 0), at(4, 4), at(2, 0), at(0, 4)}), PolygonFault::kCrossesItself) << "a corner on another edge";
  EXPECT_EQ(fault({at(0, 0), at(4, 0), at(2, 0), at(2, 3)}), PolygonFault::kCrossesItself) << "an edge back on the one before";
  EXPECT_EQ(fault({at(0, 0), at(2, 0), at(1, 0)}), PolygonFault::kCrossesItself) << "all on one line";
  EXPECT_EQ(fault({at(2, 0), at(2, 3), at(0, 0), at(4, 0)}), PolygonFault::kCrossesItself) << "the last edge back on the one before";
}

TEST(NearestOnEdges, IsTheFootOfThePerpendicularOrACorner) {
  EXPECT_EQ(nearest_on_edges(kAngle, at(5, 3)), at(4, 3));
  EXPECT_EQ(nearest_on_edges(kAngle, at(3.5, 3)), at(4, 3));
  EXPECT_EQ(nearest_on_edges(kAngle, at(1, 3)), at(2, 3)) << "in the bay, as far from one edge as from the next";
  EXPECT_EQ(nearest_on_edges(kAngle, at(7, 9)), at(4, 6));
  EXPECT_EQ(nearest_on_edges(kAngle, at(-1, -2)), at(0, 0));
  EXPECT_EQ(nearest_on_edges(kAngle, at(1, -0.5)), at(1, 0)) << "the edge from the last corner to the first";
}

TEST(KeepsWithin, HoldsUpToItsMarginFromEveryEdge) {
  const Polygon square{at(0, 0), at(10, 0), at(10, 10), at(0, 10)};
  const Polygon small{at(2, 3), at(7, 3), at(7, 8), at(2, 8)};
  EXPECT_TRUE(keeps_within(small, square, Meters{2}));
  EXPECT_FALSE(keeps_within(small, square, Meters{2.001}));
  EXPECT_TRUE(keeps_within(small, reversed(square), Meters{2}));
  EXPECT_FALSE(keeps_within(square, small, Meters{0}));
  EXPECT_FALSE(keeps_within(Polygon{at(12, 0), at(14, 0), at(14, 2)}, square, Meters{0})) << "beside it";
  EXPECT_FALSE(keeps_within(Polygon{at(1, 1), at(12, 1), at(1, 2)}, square, Meters{0})) << "a corner outside";
}

// Every corner of the bar lies in the angle, but its middle runs through the bay; and the bay's corner comes near an edge far from any
// corner.
TEST(KeepsWithin, SeesABayBetweenTheCorners) {
  const Polygon bar{at(3.9, 5.9), at(0.1, 0.2), at(0.1, 0.1)};
  for (const NorthEast corner : bar) EXPECT_TRUE(contains(kAngle, corner));
  EXPECT_FALSE(keeps_within(bar, kAngle, Meters{0}));
  const Polygon near_corner{at(3.5, 5), at(2.1, 1.5), at(3.5, 1)};
  EXPECT_TRUE(keeps_within(near_corner, kAngle, Meters{0.1}));
  EXPECT_FALSE(keeps_within(near_corner, kAngle, Meters{0.4})) << "the corner at (2, 2) is nearer to an edge of the inner one";
}

}  // namespace
}  // namespace earshot
