#include "sim/pe/section.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <stdexcept>
#include <string>

namespace earshot::pe {
namespace {

const double kNan = std::numeric_limits<double>::quiet_NaN();

Section shelf() {
  return {.floor = {{0.0, 200.0}, {1'000.0, 100.0}},
          .water = {{0.0, ocean::TabulatedProfile{{0.0, 200.0}, {1500.0, 1480.0}}},
                    {2'000.0, ocean::TabulatedProfile{{0.0, 200.0}, {1520.0, 1500.0}}}},
          .sediment = {{0.0, {{0.0, 1600.0, 1.5, 0.5}}}, {500.0, {{0.0, 1700.0, 1.9, 0.8}}}}};
}

TEST(Section, IsLinearInRangeBetweenItsPointsAndConstantBeyond) {
  const Section section = shelf();
  EXPECT_EQ(section.floor_depth_m(250.0), 175.0);
  EXPECT_EQ(section.floor_depth_m(9'000.0), 100.0);
  EXPECT_EQ(section.water_sound_speed_mps(500.0, 100.0), 1495.0);
  EXPECT_EQ(section.water_sound_speed_mps(9'000.0, 0.0), 1520.0);
  EXPECT_EQ(section.sediment_at(499.0).points[0].sound_speed_mps, 1600.0);
  EXPECT_EQ(section.sediment_at(500.0).points[0].sound_speed_mps, 1700.0);
}

TEST(Section, MakesInterfacesOfLayers) {
  const auto points = sediment_points(
      {{.thickness = Meters{20.0}, .sound_speed = MetersPerSecond{1500.0}}, {.thickness = {}, .sound_speed = MetersPerSecond{1800.0}}});
  ASSERT_EQ(points.size(), 3U);
  EXPECT_EQ(points[1].depth_below_floor_m, 20.0);
  EXPECT_EQ(points[1].sound_speed_mps, 1500.0);
  EXPECT_EQ(points[2].depth_below_floor_m, 20.0);
  EXPECT_EQ(points[2].sound_speed_mps, 1800.0);
}

void expect_refused(const std::string& because, const std::function<void(Section&)>& spoil, double source_depth_m = 50.0) {
  Section section = shelf();
  spoil(section);
  try {
    require_valid(section, Meters{source_depth_m});
    ADD_FAILURE() << "accepted: " << because;
  } catch (const std::invalid_argument& e) {
    EXPECT_NE(std::string(e.what()).find(because), std::string::npos) << e.what();
  }
}

TEST(Section, RefusesWhatIsNoOceanAndSaysWhichValue) {
  EXPECT_NO_THROW(require_valid(shelf(), Meters{50.0}));
  expect_refused("bathymetry at 1000 m", [](Section& s) { s.floor[1].depth_m = -5.0; });
  expect_refused("bathymetry at 1000 m", [](Section& s) { s.floor[1].depth_m = kNan; });
  expect_refused("bathymetry: range 1", [](Section& s) { s.floor[1].range_m = 0.0; });
  expect_refused("bathymetry", [](Section& s) { s.floor.clear(); });
  expect_refused("first range", [](Section& s) { s.sediment[0].range_m = 10.0; });
  expect_refused("depth 1 in m", [](Section& s) { s.water[0].profile = ocean::TabulatedProfile{{10.0, 10.0}, {1500.0, 1500.0}}; });
  expect_refused("sound speed in m/s is nan", [](Section& s) { s.water[1].profile = ocean::TabulatedProfile{{0.0}, {kNan}}; });
  expect_refused("as many sound speeds", [](Section& s) { s.water[0].profile = ocean::TabulatedProfile{{0.0, 1.0}, {1500.0}}; });
  expect_refused("sediment: density", [](Section& s) { s.sediment[0].points[0].density_g_per_cm3 = 0.0; });
  expect_refused("sediment: attenuation", [](Section& s) { s.sediment[0].points[0].attenuation_db_per_wavelength = -0.1; });
  expect_refused(
      "source depth", [](Section&) {}, 200.0);
  expect_refused(
      "source depth", [](Section&) {}, kNan);
}

}  // namespace
}  // namespace earshot::pe
