#include "sim/ocean/file/profile_csv.hpp"

#include <cstddef>
#include <string>
#include <utility>

#include "sim/ocean/file/csv_table.hpp"

namespace earshot::ocean {
namespace {

using host::Range;

std::vector<double> read_sound_speed(const CsvTable& table, Radians latitude, SoundSpeedFormula formula) {
  if (table.has("sound_speed_mps")) {
    table.check("sound_speed_mps", Range::between(1300.0, 1700.0));
    return table.column("sound_speed_mps");
  }
  table.check("temperature_c", Range::between(-3.0, 45.0));
  table.check("salinity_psu", Range::between(0.0, 50.0));
  std::vector<double> sound_speed_mps;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const SeaWater water{.temperature_c = table.column("temperature_c")[row], .salinity_psu = table.column("salinity_psu")[row]};
    sound_speed_mps.push_back(sound_speed_of(water, Meters{table.column("depth_m")[row]}, latitude, formula).value);
  }
  return sound_speed_mps;
}

}  // namespace

std::vector<WaterStation> read_profile_csv(const std::filesystem::path& path, Radians latitude, SoundSpeedFormula formula) {
  const CsvTable table(path);
  table.check("depth_m", Range::between(0.0, 12'000.0));
  const std::vector<double>& depth_m = table.column("depth_m");
  const std::vector<double> sound_speed_mps = read_sound_speed(table, latitude, formula);
  if (table.has("range_m")) table.check("range_m", Range::between(0.0, 1e8));
  const std::vector<double> range_m = table.has("range_m") ? table.column("range_m") : std::vector<double>(table.rows(), 0.0);
  std::vector<std::pair<double, TabulatedProfile>> profiles;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    if (profiles.empty() || range_m[row] != profiles.back().first) {
      if (!profiles.empty() && range_m[row] < profiles.back().first) throw table.error(row, "range_m", "must not decrease");
      if (depth_m[row] != 0.0) throw table.error(row, "depth_m", "a profile must begin at 0");
      if (profiles.size() == kMostWaterStations)
        throw table.error(row, "range_m", "is one profile too many, there is room for " + std::to_string(kMostWaterStations));
      profiles.emplace_back(range_m[row], TabulatedProfile{});
    }
    TabulatedProfile& profile = profiles.back().second;
    if (!profile.depth_m.empty() && !(depth_m[row] > profile.depth_m.back())) {
      throw table.error(row, "depth_m", "must be more than in the line before");
    }
    profile.depth_m.push_back(depth_m[row]);
    profile.sound_speed_mps.push_back(sound_speed_mps[row]);
  }
  std::vector<WaterStation> stations;
  for (auto& [range, profile] : profiles) stations.push_back({.range = Meters{range}, .profile = std::move(profile)});
  return stations;
}

}  // namespace earshot::ocean
