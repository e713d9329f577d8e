#include "firmware/desk/journal_view/export/maps/flight_map.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/firmware/host/journal/known_journal.hpp"

namespace earshot::journal {
namespace {

Record record_of(Time time, Content content) {
  return {.number = 0, .time = time, .channel = "", .size_bytes = 0, .content = std::move(content)};
}

/// @param metres  from one fix to the next, one a second
FlightMap map_of_fixes(std::size_t fixes, double metres = 0.001) {
  FlightMap map({});
  for (std::size_t i = 0; i < fixes; ++i) {
    const Time time{static_cast<std::int64_t>(i) * 1'000'000};
    messages::Navigation fix = known_fix(time);
    fix.position = at(metres * static_cast<double>(i), 0);
    map.take(record_of(time, messages::Input{.arrival = time, .port = 1, .sequence = 0, .value = fix}));
  }
  map.finish();
  return map;
}

TEST(FlightMap, KeepsEveryFixOfATrackThatThereIsRoomFor) {
  const FlightMap map = map_of_fixes(FlightMap::kMostTrackPlaces - 1);
  EXPECT_EQ(map.track().size(), FlightMap::kMostTrackPlaces - 1);
  EXPECT_EQ(map.what(), "0 decisions, a track of 65535 places");
}

// 200,000 fixes: every fourth is kept, 50,000, and the last.
TEST(FlightMap, KeepsOneOfSoManyFixesOfALongerTrackAndItsEnd) {
  const FlightMap map = map_of_fixes(200'000);
  ASSERT_EQ(map.track().size(), 50'001U);
  EXPECT_EQ(map.what(), "0 decisions, a track of 50001 places, one for every 4 fixes");
  for (std::size_t i = 0; i < 50'000; ++i) ASSERT_EQ(map.track()[i].time.us, static_cast<std::int64_t>(i) * 4'000'000);
  EXPECT_EQ(map.track().back().time.us, 199'999'000'000);
}

// 2 degrees of latitude are 221 km: of fixes 50 km apart the sixth lies beyond, the fifth does not.
TEST(FlightMap, SaysHowManyPlacesItLeavesOut) {
  const FlightMap map = map_of_fixes(6, 50'000);
  EXPECT_EQ(map.track().size(), 5U);
  EXPECT_EQ(map.what(), "0 decisions, a track of 5 places; left out: 1 place more than 2 degrees from the origin");
}

TEST(FlightMap, TakesNoFixThatComesLateOrHasNoPlace) {
  FlightMap map({});
  for (const std::int64_t second : {1, 3, 2, 3, 4}) {
    const Time time{second * 1'000'000};
    messages::Navigation fix = known_fix(time);
    if (second == 4) fix.depth = Meters{std::numeric_limits<double>::quiet_NaN()};
    map.take(record_of(time, messages::Input{.arrival = time, .port = 1, .sequence = 0, .value = fix}));
  }
  map.finish();
  ASSERT_EQ(map.track().size(), 2U);
  EXPECT_EQ(map.track()[1].time.us, 3'000'000);
}

TEST(FlightMap, HasTheDepthOfADecisionFromTheNewestFixAndElseNone) {
  FlightMap map({});
  messages::Decision decision;
  decision.time = Time{1'000'000};
  map.take(record_of(decision.time, decision));
  map.take(record_of(Time{2'000'000},
                     messages::Input{.arrival = Time{2'000'000}, .port = 1, .sequence = 0, .value = known_fix(Time{2'000'000})}));
  map.take(record_of(Time{3'000'000}, decision));
  ASSERT_EQ(map.points().size(), 2U);
  EXPECT_FALSE(map.points()[0].place.has_depth());
  EXPECT_TRUE(map.points()[0].properties.at("depth_m").is_null());
  EXPECT_EQ(map.points()[1].place.depth_m, 299.5);
  EXPECT_TRUE(map.points()[0].properties.at("direction_deg").is_null());  // it stays
}

TEST(FlightMap, DrawsNoBearingFromOutsideTheOperatingAreaNorWithoutOne) {
  messages::Decision decision;
  decision.position = at(-1, 100);
  decision.bearing = messages::Bearing{.direction = Radians{0.5}, .deviation = Radians{0.1}};
  FlightMap map({});
  map.take(record_of(Time{}, decision));
  map.take(record_of(Time{}, known_mission()));
  map.take(record_of(Time{}, decision));
  EXPECT_TRUE(map.rays().empty());
  decision.position = at(1, 100);
  map.take(record_of(Time{}, decision));
  EXPECT_EQ(map.rays().size(), 1U);
}

TEST(FlightMap, HasNoTrackOfAJournalWithoutFixes) {
  FlightMap map({});
  map.finish();
  EXPECT_TRUE(map.track().empty());
}

}  // namespace
}  // namespace earshot::journal
