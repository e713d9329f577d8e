#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "firmware/host/toml/table_reader.hpp"
#include "sim/ocean/charts/climatology.hpp"
#include "sim/ocean/environment.hpp"
#include "sim/ocean/file/profile_csv.hpp"

namespace earshot::ocean {

enum class WaterSource : std::uint8_t { kKeys, kCsv, kAtlas };

struct WaterKeys {
  WaterSource from = WaterSource::kKeys;
  SoundSpeedProfile profile;           ///< kKeys
  std::vector<WaterStation> stations;  ///< kKeys, when it changes with range
  std::filesystem::path csv;           ///< kCsv
  WorldOceanAtlas atlas;               ///< kAtlas
  SoundSpeedFormula formula = SoundSpeedFormula::kUnesco;
  Meters reach;  ///< kAtlas
};

/// The table [water] of an environment file.
[[nodiscard]] WaterKeys read_water(const host::TomlFile& file, host::TableReader table);

/// Sound absorption after the table [absorption], dB/km.
[[nodiscard]] double read_absorption(host::TableReader table, Hertz frequency);

}  // namespace earshot::ocean
