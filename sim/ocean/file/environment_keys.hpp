#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <variant>
#include <vector>

#include "firmware/host/toml/table_reader.hpp"
#include "sim/ocean/charts/geography.hpp"
#include "sim/ocean/environment.hpp"
#include "sim/ocean/file/environment_seabed.hpp"
#include "sim/ocean/file/environment_water.hpp"

namespace earshot::ocean {

enum class BathymetryLayout : std::uint8_t { kSectionCsv, kGridCsv, kGebco, kSection };

struct BathymetryKeys {
  BathymetryLayout layout;
  std::filesystem::path file;
  Meters reach;
  std::vector<SeaFloorStation> section = {};  ///< kSection, which has no file
};

/// What an environment file says, before the data files it names are read.
struct EnvironmentKeys {
  Environment environment;  ///< as far as it stands in the file itself
  std::optional<GeoPosition> origin;
  WaterData water;
  std::optional<BathymetryKeys> bathymetry;

  [[nodiscard]] bool has_water_data() const { return !std::holds_alternative<std::monostate>(water); }
};

/// Reads tables of the same file that are not the ocean's, such as those of a search in it. Its problems are reported with the others.
using FurtherTables = std::function<void(const host::TomlFile& file, host::TableReader& root, const EnvironmentKeys& keys)>;

/// @param further  empty: the file may hold no tables but the ocean's
/// Throws host::BadInput with everything that is wrong with the file, one line each.
[[nodiscard]] EnvironmentKeys read_environment_keys(const host::TomlFile& file, const FurtherTables& further = {});

}  // namespace earshot::ocean
