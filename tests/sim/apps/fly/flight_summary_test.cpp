#include "sim/apps/fly/flight_summary.hpp"

#include <gtest/gtest.h>

#include <sstream>

#include "tests/support/text/tells.hpp"

namespace earshot::fly {
namespace {

nlohmann::json flown() {
  return {{"found", true},
          {"reward", -4.0},
          {"steps", 18},
          {"max_steps", 100},
          {"distance_m", 17'841.9},
          {"detections", 14},
          {"sim_time_s", 8'921.0},
          {"wall_time_s", 30.0},
          {"flown_utc", "2026-11-29 18:38:46"},
          {"end_reason", "completed"},
          {"area", {{"south_west", {{"north_m", 0.0}, {"east_m", 0.0}}}, {"north_east", {{"north_m", 25'000.0}, {"east_m", 20'000.0}}}}},
          {"origin", {{"latitude_deg", 38.5}, {"longitude_deg", -28.0}}},
          {"source_frequency_hz", 20.0},
          {"depth_m", 300.0},
          {"speed_mps", 2.0},
          {"step_length_m", 1'000.0},
          {"detection_threshold_db", 10.0}};
}

TEST(FlightSummary, IsReadByAStrangerToTheProject) {
  EXPECT_EQ(to_string_of_summary(flown()),
            "Source found after 18 steps: the vehicle came within 1.0 km of it\n"
            "  simulation  flown on 2026-11-29 18:38:46 UTC: ocean, noise and source are computed, and no vehicle\n"
            "              was at sea\n"
            "  area        25.0 km north by 20.0 km east; its south-west corner lies at 38.500 N, 28.000 W\n"
            "  vehicle     300 m deep, 2.0 m/s, steps of 1.0 km\n"
            "  source      20.0 Hz; the vehicle does not know where it is\n"
            "  reward      -4.0: 0 for each step that ends with a detection, -1 for each other, and less near the\n"
            "              area's edge\n"
            "  steps       18 of 100\n"
            "  detections  14: each is a step that ends with an SNR of 10 dB or more\n"
            "  distance    17.8 km\n"
            "  time        2 h 29 min at sea, simulated in 30.00 s: 297 times real time\n");
}

TEST(FlightSummary, DoesNotCallASourceUnknownThatLiesWhereTheEnvironmentHasIt) {
  nlohmann::json s = flown();
  s["source_is_fixed"] = true;
  EXPECT_TRUE(support::has_line(to_string_of_summary(s), {"source", "20.0 Hz", "environment"}));
  s["source_is_fixed"] = false;
  EXPECT_TRUE(support::has_line(to_string_of_summary(s), {"20.0 Hz", "vehicle", "not know"}));
}

TEST(FlightSummary, OfAnEarlierVersionLeavesOutWhatItDoesNotKnow) {
  nlohmann::json s = flown();
  for (const char* key : {"flown_utc", "origin", "source_frequency_hz", "speed_mps", "area", "max_steps"}) s.erase(key);
  const std::string text = to_string_of_summary(s);
  for (const char* label : {"  area ", "  vehicle ", "  source "}) EXPECT_EQ(text.find(label), std::string::npos) << label;
  EXPECT_NE(text.find("  steps       18\n"), std::string::npos) << text;
}

TEST(FlightSummary, FitsATerminal) {
  nlohmann::json s = flown();
  s["found"] = false;
  s["end_reason"] = "safety_rule";
  s["ended_by"] = {{"what", "rule 12, depth_unexplained_m: the depth is 275.0 m further from its set-points than it may be: abort"}};
  std::istringstream lines(to_string_of_summary(s));
  for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 100U) << line;
}

}  // namespace
}  // namespace earshot::fly
