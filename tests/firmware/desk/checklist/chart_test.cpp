#include "firmware/desk/checklist/chart.hpp"

#include <gtest/gtest.h>

#include <string>
#include <utility>

#include "firmware/host/mission/mission_file.hpp"

namespace earshot::board {
namespace {

const std::string kMissions = std::string(EARSHOT_SOURCE_DIR) + "/firmware/boards/linux/missions/";

std::size_t count_of(const std::string& text, const std::string& what) {
  std::size_t count = 0;
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++count;
  return count;
}

TEST(Chart, DrawsAreaTiersZonesAndSafePointWithTheirNames) {
  const std::string svg = chart(host::load_mission(kMissions + "fenced_search.toml").mission, "a & <b>");
  EXPECT_EQ(svg.rfind("<svg ", 0), 0U);
  EXPECT_TRUE(svg.ends_with("</svg>\n"));
  EXPECT_EQ(count_of(svg, "<polygon "), 6U) << "area, way-points, three tiers, a zone";
  EXPECT_EQ(count_of(svg, "<circle "), 2U) << "on the chart and in its legend";
  for (const char* const name : {"search area", "way-points", "inside", "save", "halt", "no surfacing", "safe point"})
    EXPECT_EQ(count_of(svg, ">" + std::string(name) + "<"), 1U) << name;
  EXPECT_NE(svg.find("a &amp; &lt;b>"), std::string::npos);
}

// The mission's easternmost and northernmost places are those of its halt polygon: -2 to 27 km east, -2 to 29.6 km north. The chart is a
// square of 640 about their middle, (12.5, 13.8) km, with 1.08 x 31.6 km = 34.128 km a side.
TEST(Chart, PutsEveryPlaceWhereItBelongs) {
  const std::string svg = chart(host::load_mission(kMissions + "fenced_search.toml").mission, "");
  // The safe point, 2 km north and 3 km east: x = 90 + 640 (3 - 12.5 + 17.064) / 34.128, y = 60 + 640 - 640 (2 - 13.8 + 17.064) / 34.128.
  EXPECT_NE(svg.find("cx=\"231.85\" cy=\"601.28\""), std::string::npos) << svg;
  // The halt polygon's first corner, 2 km south and 2 km west.
  EXPECT_NE(svg.find("points=\"138.08,676.30 "), std::string::npos) << svg;
}

TEST(Chart, SaysThatThereIsNoFence) {
  const std::string svg = chart(host::load_mission(kMissions + "search.toml").mission, "");
  EXPECT_NE(svg.find("halt: no fence"), std::string::npos);
  EXPECT_EQ(count_of(svg, "<circle "), 0U);
}

TEST(Chart, SaysThatOneLineCoversAnother) {
  config::Mission mission = host::load_mission(kMissions + "fenced_search.toml").mission;
  EXPECT_EQ(chart(mission, "").find("on the area's edges"), std::string::npos);
  config::Polygon area;  // from its north-west corner, the other way round
  for (const auto& [north, east] : {std::pair{25'000.0, 0.0}, {0.0, 0.0}, {0.0, 25'000.0}, {25'000.0, 25'000.0}})
    (void)area.push_back({.north = Meters{north}, .east = Meters{east}});
  mission.safety.fence->inside = area;
  EXPECT_NE(chart(mission, "").find(">inside, on the area's edges<"), std::string::npos);
}

}  // namespace
}  // namespace earshot::board
