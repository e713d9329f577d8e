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
  std::filesystem::copy_file(std::filesystem::path(EARSHOT_SOURCE_DIR) / "tests/sim/sonar/hilly.toml", folder / "hilly.toml",
                             std::filesystem::copy_options::overwrite_existing);
  return folder / "hilly.toml";
}

}  // namespace earshot::tests
