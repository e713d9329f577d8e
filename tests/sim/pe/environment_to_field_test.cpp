// From an environment file and its data to the field: the whole way.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <complex>
#include <fstream>
#include <string>
#include <vector>

#include "sim/ocean/file/environment_file.hpp"
#include "sim/ocean/section_along.hpp"
#include "sim/pe/solver.hpp"
#include "tests/reference/transmission_loss.hpp"
#include "tests/support/temporary_folder.hpp"

namespace earshot::pe {
namespace {

class EnvironmentToField : public testing::Test {
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
  support::TemporaryFolder folder_;
};

TEST_F(EnvironmentToField, TakesTheAsaWedgeFromItsFilesToTheFullWaveReference) {
  const Meters max_range{3900.0};
  const ocean::Environment environment = wedge();
  const std::vector<double> depth_m = {30.0, 150.0};
  const Field field = solve(ocean::section_along(environment, environment.source.position, Radians{}, max_range),
                            {environment.source.frequency, environment.source.depth}, {.output_step = Meters{5.0}}, depth_m, max_range);
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

}  // namespace
}  // namespace earshot::pe
