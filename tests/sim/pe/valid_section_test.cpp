#include "sim/pe/valid_section.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <stdexcept>
#include <string>

#include "tests/sim/pe/short_section.hpp"

namespace earshot::pe {
namespace {

const double kNan = std::numeric_limits<double>::quiet_NaN();

ocean::Section shelf() {
  return tests::section_of({.floor = {{0.0, 200.0}, {1'000.0, 100.0}},
                            .water = {{0.0, ocean::TabulatedProfile{{0.0, 200.0}, {1500.0, 1480.0}}},
                                      {2'000.0, ocean::TabulatedProfile{{0.0, 200.0}, {1520.0, 1500.0}}}},
                            .sediment = {{0.0, {{0.0, 1600.0, 1.5, 0.5}}}, {500.0, {{0.0, 1700.0, 1.9, 0.8}}}}});
}

void expect_refused(const std::string& because, const std::function<void(ocean::Section&)>& spoil, double source_depth_m = 50.0) {
  ocean::Section section = shelf();
  spoil(section);
  try {
    require_valid(section, Meters{source_depth_m});
    ADD_FAILURE() << "accepted: " << because;
  } catch (const std::invalid_argument& e) {
    EXPECT_NE(std::string(e.what()).find(because), std::string::npos) << e.what();
  }
}

TEST(ValidSection, RefusesWhatIsNoOceanAndSaysWhichValue) {
  EXPECT_NO_THROW(require_valid(shelf(), Meters{50.0}));
  expect_refused("bathymetry at 1000 m", [](ocean::Section& s) { s.sea_floor[1].depth = Meters{-5.0}; });
  expect_refused("bathymetry at 1000 m", [](ocean::Section& s) { s.sea_floor[1].depth = Meters{kNan}; });
  expect_refused("bathymetry: range 1", [](ocean::Section& s) { s.sea_floor[1].range = Meters{0.0}; });
  expect_refused("bathymetry", [](ocean::Section& s) { s.sea_floor.clear(); });
  expect_refused("first range", [](ocean::Section& s) { s.sediment[0].range = Meters{10.0}; });
  expect_refused("depth 1 in m", [](ocean::Section& s) { s.water[0].profile = ocean::TabulatedProfile{{10.0, 10.0}, {1500.0, 1500.0}}; });
  expect_refused("sound speed in m/s is nan", [](ocean::Section& s) { s.water[1].profile = ocean::TabulatedProfile{{0.0}, {kNan}}; });
  expect_refused("as many sound speeds", [](ocean::Section& s) { s.water[0].profile = ocean::TabulatedProfile{{0.0, 1.0}, {1500.0}}; });
  expect_refused("sediment: density", [](ocean::Section& s) { s.sediment[0].layers[0].density_g_per_cm3 = 0.0; });
  expect_refused("sediment: attenuation", [](ocean::Section& s) { s.sediment[0].layers[0].attenuation_db_per_wavelength = -0.1; });
  expect_refused(
      "source depth", [](ocean::Section&) {}, 200.0);
  expect_refused(
      "source depth", [](ocean::Section&) {}, kNan);
}

}  // namespace
}  // namespace earshot::pe
