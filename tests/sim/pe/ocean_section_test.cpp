#include "sim/pe/ocean_section.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <fstream>
#include <string>
#include <vector>

#include "sim/ocean/file/environment_file.hpp"
#include "sim/pe/solver.hpp"
#include "tests/reference/transmission_loss.hpp"
#include "tests/sim/netcdf/temporary_folder.hpp"

namespace earshot::pe {
namespace {

ocean::SedimentLayer half_space(double sound_speed_mps) {
  return {.thickness = Meters{}, .sound_speed = MetersPerSecond{sound_speed_mps}};
}

ocean::TabulatedProfile isovelocity(double sound_speed_mps) {
  return {.depth_m = {0.0}, .sound_speed_mps = {sound_speed_mps}};
}

TEST(OceanSection, KeepsWhatBeginsBeyondRangeZeroConstantUpToThere) {
  const ocean::Section radial{
      .water = {{.range = Meters{1000.0}, .profile = isovelocity(1500.0)}, {.range = Meters{3000.0}, .profile = isovelocity(1520.0)}},
      .sea_floor = {{.range = Meters{2000.0}, .depth = Meters{200.0}}, {.range = Meters{4000.0}, .depth = Meters{100.0}}},
      .sediment = {{.range = Meters{500.0}, .layers = {half_space(1600.0)}}, {.range = Meters{5000.0}, .layers = {half_space(1700.0)}}},
      .shore = {}};
  const Section section = make_section(radial, 0.25);
  require_valid(section, Meters{50.0});
  for (const double range_m : {0.0, 700.0, 1500.0, 2500.0, 3999.0, 6000.0}) {
    EXPECT_NEAR(section.floor_depth_m(range_m), sea_floor_depth(radial, Meters{range_m}).value, 1e-9) << range_m;
    EXPECT_NEAR(section.water_sound_speed_mps(range_m, 20.0), sound_speed(radial, Meters{range_m}, Meters{20.0}).value, 1e-9) << range_m;
    EXPECT_EQ(section.sediment_at(range_m).points.front().sound_speed_mps,
              sediment_layers(radial, Meters{range_m}).front().sound_speed.value)
        << range_m;
  }
  EXPECT_EQ(section.water_attenuation_db_per_km, 0.25);
}

class OceanSectionFile : public testing::Test {
 protected:
  ocean::Environment wedge() {
    std::ofstream(folder_ / "wedge.csv") << "range_m,depth_m\n0,200\n4000,0\n";
    std::ofstream(folder_ / "wedge.toml") << R"(name = "ASA wedge"
[source]
frequency_hz = 25.0
level_db_re_1upa_at_1m = 180.0
depth_m = 100.0
north_m = 0.0
east_m = 0.0
[noise]
level_db_re_1upa = 80.0
[water]
profile = "table"
depth_m = [0.0, 200.0]
sound_speed_mps = [1500.0, 1500.0]
[bathymetry]
layout = "section_csv"
file = "wedge.csv"
[seabed]
[[seabed.layers]]
sound_speed_mps = 1700.0
density_g_per_cm3 = 1.5
attenuation_db_per_wavelength = 0.5
)";
    return ocean::load_environment(folder_ / "wedge.toml");
  }
  tests::TemporaryFolder folder_;
};

TEST_F(OceanSectionFile, TakesTheAsaWedgeFromItsFilesToTheFullWaveReference) {
  const Meters max_range{3900.0};
  const ocean::Environment environment = wedge();
  const std::vector<double> depth_m = {30.0, 150.0};
  const Field field = solve(make_section(environment, Radians{}, max_range), {environment.source.frequency, environment.source.depth},
                            {.output_step = Meters{5.0}}, depth_m, max_range);
  const std::array<double, 2> tolerance_db = {0.15, 0.25};  // the case's own
  for (int column = 0; column < 2; ++column) {
    reference::TransmissionLoss loss;
    for (Eigen::Index row = 0; row < field.pressure.rows(); ++row) {
      loss[static_cast<int>(std::lround(static_cast<double>(row + 1) * field.range_step.value))] =
          -20.0 * std::log10(std::abs(field.pressure(row, column)));
    }
    const auto truth = reference::load("asa_wedge", column);
    const auto difference = reference::compare(loss, truth, 500, 3900, reference::DeepMinimum(truth, 300));
    EXPECT_GT(difference.count, 600);
    EXPECT_LT(difference.mean_db, tolerance_db[static_cast<std::size_t>(column)]);
  }
}

TEST_F(OceanSectionFile, IsAskedForWhereOneRadialDoesNotTellTheWholeOcean) {
  EXPECT_THROW((void)make_section(wedge()), std::invalid_argument);
}

}  // namespace
}  // namespace earshot::pe
