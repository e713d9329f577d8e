#pragma once

#include <filesystem>
#include <variant>

#include "firmware/host/toml/table_reader.hpp"
#include "sim/ocean/charts/climatology.hpp"
#include "sim/ocean/environment.hpp"
#include "sim/ocean/file/profile_csv.hpp"

namespace earshot::ocean {

struct WaterCsv {
  std::filesystem::path file;
  SoundSpeedFormula formula;
};

struct WaterAtlas {
  WorldOceanAtlas files;
  SoundSpeedFormula formula;
  Meters reach;
};

/// The data that the water is read from; none: the environment file itself says all of it.
using WaterData = std::variant<std::monostate, WaterCsv, WaterAtlas>;

/// The table [water] of an environment file: what stands there of the water goes into `environment`.
[[nodiscard]] WaterData read_water(const host::TomlFile& file, host::TableReader table, Environment& environment);

/// The table [absorption] of an environment file.
[[nodiscard]] AbsorbingWater read_absorption(host::TableReader table);

}  // namespace earshot::ocean
