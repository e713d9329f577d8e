#include "sim/ocean/with_source.hpp"

#include <gtest/gtest.h>

#include <string>

#include "firmware/host/file/bad_input.hpp"
#include "sim/ocean/file/environment_file.hpp"

namespace earshot::ocean {
namespace {

Environment ocean_with_source(const std::string& frequency_hz, const std::string& depth_m, const std::string& absorption) {
  return environment_of_text("text", "name = \"n\"\n[source]\nfrequency_hz = " + frequency_hz +
                                         "\nlevel_db_re_1upa_at_1m = 190\ndepth_m = " + depth_m +
                                         "\nnorth_m = 0\neast_m = 0\n[noise]\nlevel_db_re_1upa = 90\n[water]\nprofile = \"table\"\n"
                                         "depth_m = [0, 500]\nsound_speed_mps = [1500, 1500]\n[seabed]\ndepth_m = 500\n"
                                         "[[seabed.layers]]\nsound_speed_mps = 1600\n" +
                                         absorption);
}

constexpr const char* kAbsorption = "[absorption]\ntemperature_c = 10\nsalinity_psu = 35\ndepth_m = 100\n";

TEST(WithSource, IsWhatTheFileWouldGive) {
  const Environment written = ocean_with_source("1250.5", "77.25", kAbsorption);
  const Environment changed = with_source(ocean_with_source("20", "30", kAbsorption), Hertz{1250.5}, Meters{77.25}, "depth");
  EXPECT_EQ(changed.source.frequency, written.source.frequency);
  EXPECT_EQ(changed.source.depth, written.source.depth);
  EXPECT_GT(written.absorption_db_per_km, 0.01);  // Francois & Garrison, Fig. 10: some 0.07 dB/km at 1 kHz
  EXPECT_EQ(changed.absorption_db_per_km, written.absorption_db_per_km);
}

TEST(WithSource, AbsorbsNothingWhereNothingAbsorbed) {
  EXPECT_EQ(with_source(ocean_with_source("20", "30", ""), Hertz{1000.0}, Meters{30.0}, "depth").absorption_db_per_km, 0.0);
}

TEST(WithSource, RefusesASourceOnTheSeaFloorOrBelowByItsName) {
  const Environment ocean = ocean_with_source("20", "30", "");
  EXPECT_EQ(with_source(ocean, Hertz{20.0}, Meters{499.75}, "--depth").source.depth, Meters{499.75});
  for (const double depth_m : {500.0, 600.0}) {
    try {
      (void)with_source(ocean, Hertz{20.0}, Meters{depth_m}, "--depth");
      ADD_FAILURE() << depth_m;
    } catch (const host::BadInput& bad) {
      EXPECT_EQ(bad.what(),
                "--depth = " + std::to_string(static_cast<int>(depth_m)) + ": must be less than the depth of the sea floor there, 500 m");
    }
  }
}

}  // namespace
}  // namespace earshot::ocean
