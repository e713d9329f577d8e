#pragma once

#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>

namespace earshot::tests {

/// An ocean 2500 m deep on the equator with a hill in the west and an island 7 km in the east, the same north and south of it; its chart
/// reaches 22 km in every direction. @return the environment file
inline std::filesystem::path write_hilly_ocean(const std::filesystem::path& folder) {
  std::ofstream chart(folder / "chart.csv");
  chart << "latitude_deg,longitude_deg,elevation_m\n";
  for (int i = -10; i <= 10; ++i) {
    for (int j = -10; j <= 10; ++j) {
      const double north_km = 2.2 * i;
      const double east_km = 2.2 * j;
      const double island = 3600.0 * std::exp(-(std::pow(east_km - 7.0, 2) + std::pow(north_km, 2)) / 4.0);
      const double hill = 500.0 * std::exp(-(std::pow(east_km + 9.0, 2) + std::pow(north_km, 2)) / 30.0);
      chart << 0.02 * i << ',' << 0.02 * j << ',' << -2500.0 + island + hill << '\n';
    }
  }
  std::ofstream(folder / "hilly.toml") << R"(name = "hill and island"
[origin]
latitude_deg = 0.0
longitude_deg = 0.0
[source]
frequency_hz = 20.0
level_db_re_1upa_at_1m = 190.0
depth_m = 30.0
north_m = 0.0
east_m = 0.0
[noise]
level_db_re_1upa = 90.0
[water]
profile = "munk"
axis_sound_speed_mps = 1500.0
axis_depth_m = 1300.0
scale_m = 1300.0
perturbation = 0.00737
[bathymetry]
layout = "grid_csv"
file = "chart.csv"
[seabed]
[[seabed.layers]]
sound_speed_mps = 1600.0
density_g_per_cm3 = 1.8
attenuation_db_per_wavelength = 0.5
)";
  return folder / "hilly.toml";
}

}  // namespace earshot::tests
