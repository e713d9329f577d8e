#include "sim/search/soundscape.hpp"

#include <gtest/gtest.h>

namespace earshot::search {
namespace {

constexpr NorthEast at(double north_m, double east_m) {
  return {Meters{north_m}, Meters{east_m}};
}

/// 50 dB of loss to the north, one more per kilometre; 80 dB to east, south and west.
SnrFan fan_at(NorthEast centre, double level_db) {
  SnrFan result{.fan = {.centre = centre,
                        .bearings = 4,
                        .ranges = 10,
                        .range_step = Meters{1'000.0},
                        .depth_m = {300.0},
                        .transmission_loss_db = std::vector<float>(40, 80.0F),
                        .sea_floor_depth_m = {}},
                .source_level = Decibels{level_db},
                .noise_level = Decibels{90.0}};
  for (std::size_t i = 0; i < 10; ++i) result.fan.transmission_loss_db[i] = 50.0F + static_cast<float>(i + 1);
  return result;
}

TEST(Soundscape, HearsDifferentlyByBearingWhereTheOceanDoes) {
  const Soundscape soundscape(sonar::SnrCurve(Meters{1'000.0}, {0.0F}), {fan_at(at(0, 0), 190.0)});
  const std::size_t field = soundscape.field_of(0, at(5'000, 5'000));
  EXPECT_EQ(soundscape.snr(field, at(5'000, 5'000), at(9'000, 5'000)), Decibels{190.0 - 54.0 - 90.0});  // 4 km north
  EXPECT_EQ(soundscape.snr(field, at(5'000, 5'000), at(1'000, 5'000)), Decibels{190.0 - 80.0 - 90.0});  // 4 km south
}

TEST(Soundscape, TakesTheFanNearestToTheSource) {
  const Soundscape soundscape(sonar::SnrCurve(Meters{1'000.0}, {0.0F}), {fan_at(at(0, 0), 190.0), fan_at(at(20'000, 0), 200.0)});
  EXPECT_EQ(soundscape.field_of(0, at(9'000, 0)), 0U);
  EXPECT_EQ(soundscape.field_of(0, at(11'000, 0)), 1U);
  EXPECT_EQ(soundscape.snr(1, at(11'000, 0), at(10'000, 0)), Decibels{200.0 - 80.0 - 90.0});
}

TEST(Soundscape, HearsNothingWhereThereIsNoWater) {
  const Soundscape soundscape(sonar::SnrCurve(Meters{1'000.0}, {0.0F}), {fan_at(at(0, 0), 190.0)});
  EXPECT_EQ(soundscape.snr(0, at(0, 0), at(50'000, 0)), Decibels{190.0 - 300.0 - 90.0});  // beyond the last range
}

TEST(Soundscape, DrawsAmongItsCurvesOnly) {
  EXPECT_EQ(Soundscape({sonar::SnrCurve(Meters{1.0}, {0.0F}), sonar::SnrCurve(Meters{1.0}, {0.0F})}).ocean_count(), 2U);
  EXPECT_EQ(Soundscape(sonar::SnrCurve(Meters{1.0}, {0.0F}), {fan_at(at(0, 0), 1.0), fan_at(at(1, 0), 1.0)}).ocean_count(), 1U);
}

}  // namespace
}  // namespace earshot::search
