#include "firmware/desk/journal_view/export/maps/places.hpp"

#include <gtest/gtest.h>

#include "tests/firmware/place.hpp"

namespace earshot::journal {
namespace {

MapPlace at_degrees(double longitude_deg, double latitude_deg) {
  return {.latitude_deg = latitude_deg, .longitude_deg = longitude_deg};
}

/// Twice the area, positive when counterclockwise.
double doubled_area(const std::vector<MapPlace>& ring) {
  double sum = 0.0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const MapPlace& next = ring[(i + 1) % ring.size()];
    sum += ring[i].longitude_deg * next.latitude_deg - next.longitude_deg * ring[i].latitude_deg;
  }
  return sum;
}

TEST(MapPlaces, AreNothingBeyondThePlane) {
  EXPECT_FALSE(place_of(at(1e7, 0), {}));
  EXPECT_TRUE(place_of(at(1e4, 0), {}));
}

TEST(MapPlaces, AreWrittenToACentimetreAndAMillimetre) {
  EXPECT_EQ(degrees_text(-20.1), "-20.1000000");
  MapPlace place;
  EXPECT_FALSE(place.has_depth());
  place.depth_m = 299.5;
  EXPECT_EQ(altitude_text(place), "-299.500");
  place.depth_m = 0.0;
  EXPECT_EQ(altitude_text(place), "0.000");
}

// From 179 to -179 degrees are two degrees: the meridian lies half-way.
TEST(MapPieces, OfALineEndAtTheMeridianWithTimeAndDepthFromBetweenItsNeighbours) {
  std::vector<MapPlace> line{at_degrees(178, 0), at_degrees(179, 1), at_degrees(-179, 3)};
  line[1].depth_m = 100;
  line[1].time = Time{4'000'000};
  line[2].depth_m = 200;
  line[2].time = Time{6'000'000};
  const auto pieces = pieces_of_line(line);
  ASSERT_EQ(pieces.size(), 2U);
  ASSERT_EQ(pieces[0].size(), 3U);
  ASSERT_EQ(pieces[1].size(), 2U);
  EXPECT_EQ(pieces[0][2].longitude_deg, 180.0);
  EXPECT_EQ(pieces[1][0].longitude_deg, -180.0);
  for (const MapPlace& cut : {pieces[0][2], pieces[1][0]}) {
    EXPECT_DOUBLE_EQ(cut.latitude_deg, 2.0);
    EXPECT_DOUBLE_EQ(cut.depth_m, 150.0);
    EXPECT_EQ(cut.time.us, 5'000'000);
  }
}

TEST(MapPieces, OfALineGoTheSameWayTowardsTheWest) {
  const auto pieces = pieces_of_line(std::vector{at_degrees(-179, 1), at_degrees(179, 3)});
  ASSERT_EQ(pieces.size(), 2U);
  EXPECT_EQ(pieces[0][1].longitude_deg, -180.0);
  EXPECT_EQ(pieces[1][0].longitude_deg, 180.0);
}

TEST(MapPieces, OfALineThatIsNoneAreNone) {
  EXPECT_TRUE(pieces_of_line({}).empty());
  EXPECT_TRUE(pieces_of_line(std::vector{at_degrees(1, 1)}).empty());
  EXPECT_EQ(pieces_of_line(std::vector{at_degrees(1, 1), at_degrees(2, 2)}).size(), 1U);
}

TEST(MapPieces, OfARingAreCounterclockwiseWhicheverWayItWent) {
  const std::vector<MapPlace> clockwise{at_degrees(0, 0), at_degrees(0, 2), at_degrees(3, 2), at_degrees(3, 0)};
  const std::vector<MapPlace> counterclockwise(clockwise.rbegin(), clockwise.rend());
  for (const auto& ring : {clockwise, counterclockwise}) {
    const auto pieces = pieces_of_ring(ring);
    ASSERT_EQ(pieces.size(), 1U);
    EXPECT_DOUBLE_EQ(doubled_area(pieces[0]), 12.0);
  }
}

// A rectangle from 179 to -178 degrees: one degree of three lies west of the meridian.
TEST(MapPieces, OfARingThatCrossesTheMeridianHaveItsAreaBetweenThem) {
  for (const double sign : {1.0, -1.0}) {
    const std::vector<MapPlace> ring{at_degrees(sign * 179, 0), at_degrees(sign * -178, 0), at_degrees(sign * -178, 2),
                                     at_degrees(sign * 179, 2)};
    const auto pieces = pieces_of_ring(ring);
    ASSERT_EQ(pieces.size(), 2U);
    EXPECT_DOUBLE_EQ(doubled_area(pieces[0]), 4.0);
    EXPECT_DOUBLE_EQ(doubled_area(pieces[1]), 8.0);
    for (const MapPlace& corner : pieces[0]) EXPECT_GE(sign * corner.longitude_deg, 179.0);
    for (const MapPlace& corner : pieces[1]) EXPECT_LE(sign * corner.longitude_deg, -178.0);
  }
}

TEST(MapPieces, OfARingThatOnlyTouchesTheMeridianAreOne) {
  EXPECT_EQ(pieces_of_ring(std::vector{at_degrees(179, 0), at_degrees(180, 0), at_degrees(180, 2)}).size(), 1U);
  EXPECT_TRUE(pieces_of_ring(std::vector{at_degrees(1, 1), at_degrees(2, 2)}).empty());
}

}  // namespace
}  // namespace earshot::journal
