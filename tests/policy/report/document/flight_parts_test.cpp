#include "policy/report/document/flight_parts.hpp"

#include <gtest/gtest.h>

namespace earshot::report {
namespace {

HeardSound sound_of(std::vector<double> frequency_hz, std::vector<double> time_s, std::vector<double> level_db) {
  return {.measurements = {{.time_s = 105.5, .snr_db = 12.5, .modelled_snr_db = 12.125}, {.time_s = 106.5, .modelled_too_faint = true}},
          .spectrogram = {.frequency_hz = std::move(frequency_hz), .time_s = std::move(time_s), .level_db = std::move(level_db)}};
}

// A third of 30 dB is 85 of 255; base64 of 0, 85, 170, 255 by coreutils' base64.
TEST(SoundValue, IsAByteForEachCellBetweenTheLeastAndTheMost) {
  EXPECT_EQ(sound_value(sound_of({10, 20}, {105, 115}, {40, 50, 60, 70}), 100.0).dump(),
            R"({"frequency_hz":[10,20],"time_s":[5,15],"level_db_re_1upa2_per_hz":{"least":40,"most":70,"cells":"AFWq/w=="},)"
            R"("modelled":{"time_s":[5.5,6.5],"snr_db":[12.13,null]}})");
  EXPECT_TRUE(sound_value({}, 0.0).is_null());
}

/// 3,000 rows of 300 columns become 1,500 of 150; the mean intensity of 10 dB and 20 dB is 55, 17.4 dB.
TEST(SoundValue, OfALongSpectrogramHasTheMeanIntensityOfNeighbours) {
  std::vector<double> frequency_hz;
  std::vector<double> time_s;
  for (int i = 0; i < 300; ++i) frequency_hz.push_back(10.0 * i);
  for (int i = 0; i < 3'000; ++i) time_s.push_back(2.0 * i);
  std::vector<double> level_db(300U * 3'000U, 0.0);
  for (const std::size_t i : {0U, 1U}) {
    level_db[i] = 10.0;
    level_db[300U + i] = 20.0;
  }
  const nlohmann::ordered_json sound = sound_value(sound_of(frequency_hz, time_s, level_db), 0.0);
  ASSERT_EQ(sound.at("time_s").size(), 1'500U);
  ASSERT_EQ(sound.at("frequency_hz").size(), 150U);
  EXPECT_EQ(sound.at("time_s").at(1), 5) << "the mean of 4 and 6";
  EXPECT_EQ(sound.at("frequency_hz").at(0), 5);
  EXPECT_EQ(sound.at("level_db_re_1upa2_per_hz").at("most"), 17.4);
  EXPECT_EQ(sound.at("level_db_re_1upa2_per_hz").at("least"), 0);
}

TEST(TruthValue, HasAtMostFiveHundredRanges) {
  FlightFiles files;
  files.summary = {{"source", {{"north_m", 1.0}, {"east_m", 2.0}}}};
  for (int i = 0; i < 1'200; ++i) files.snr.push_back({.range_m = 10.0 * i, .snr_db = -1.0 * i});
  const nlohmann::ordered_json curve = truth_value(files).at("snr_of_range");
  ASSERT_EQ(curve.at("range_m").size(), 400U);
  EXPECT_EQ(curve.at("range_m").at(1), 30);
  EXPECT_EQ(curve.at("snr_db").at(1), -3);
  EXPECT_TRUE(truth_value({}).is_null());
}

TEST(MissionValue, HasItsFenceItsZonesAndItsOrigin) {
  config::Mission mission;
  const auto square = [](double side) {
    config::Polygon polygon;
    for (const NorthEast corner : {NorthEast{}, NorthEast{Meters{side}, Meters{0}}, NorthEast{Meters{side}, Meters{side}}})
      (void)polygon.push_back(corner);
    return polygon;
  };
  mission.safety.fence = config::Fence{.inside = square(1), .save = square(2), .halt = square(3)};
  (void)mission.safety.no_surface.push_back(square(4));
  mission.safety.safe_point = NorthEast{Meters{5}, Meters{6}};
  const nlohmann::ordered_json value = mission_value(mission, {{"origin", {{"latitude_deg", 38.5}, {"longitude_deg", -28.0}}}});
  EXPECT_EQ(value.at("fence_inside").at(1).dump(), R"({"north_m":1,"east_m":0})");
  EXPECT_EQ(value.at("fence_save").at(1).at("north_m"), 2);
  EXPECT_EQ(value.at("fence_halt").at(2).dump(), R"({"north_m":3,"east_m":3})");
  EXPECT_EQ(value.at("no_surface_zones").at(0).at(1).at("north_m"), 4);
  EXPECT_EQ(value.at("safe_point").dump(), R"({"north_m":5,"east_m":6})");
  EXPECT_EQ(value.at("origin").at("latitude_deg"), 38.5);
}

TEST(HealthValue, ListsEveryPort) {
  messages::Health health;
  (void)health.ports.push_back({.port = 2, .link_up = false, .received = 3, .lost = 4, .malformed = 5, .unsent = 6});
  EXPECT_EQ(health_value(health).at("ports").dump(), R"([{"port":2,"link_up":false,"received":3,"lost":4,"malformed":5,"unsent":6}])");
}

}  // namespace
}  // namespace earshot::report
