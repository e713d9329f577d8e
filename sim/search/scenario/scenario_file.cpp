#include "sim/search/scenario/scenario_file.hpp"

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <variant>

#include "firmware/core/crc32.hpp"
#include "firmware/host/file/file_checksum.hpp"
#include "sim/field_library/reader.hpp"
#include "sim/ocean/file/environment_file.hpp"
#include "sim/search/scenario/conditions_table.hpp"
#include "sim/search/scenario/family.hpp"
#include "sim/search/scenario/file_kind.hpp"

namespace earshot::search {
namespace {

using host::BadInput;
using host::TableReader;

constexpr std::size_t kMostOceans = 1'000;  // as [family] may have members: a propagation model is solved in each

/// Another environment that may be the true one, and where the file names it: "ocean.toml:31: oceans 1: environment".
struct OtherOcean {
  std::string place;
  std::filesystem::path file;
};

/// The tables of a search, before the files they name are read.
struct ScenarioKeys {
  Conditions conditions;
  std::vector<OtherOcean> other_oceans;
  std::optional<Family> family;
  std::filesystem::path field_library;

  [[nodiscard]] bool is_one_ocean() const { return other_oceans.empty() && !family && field_library.empty() && is_calm(conditions); }
};

struct FileKeys {
  ocean::EnvironmentKeys environment;
  ScenarioKeys scenario;
};

/// Another checksum, lowest byte first.
std::uint32_t crc32_of(std::uint32_t checksum, std::uint32_t previous) {
  static_assert(std::endian::native == std::endian::little);
  return crc32(std::bit_cast<std::array<std::uint8_t, 4>>(checksum), previous);
}

/// The family is drawn from the file's own ocean, which must have the numbers that are drawn.
Family read_own_family(TableReader table, const ocean::EnvironmentKeys& keys) {
  Family family = read_family(table);
  const ocean::Environment& environment = keys.environment;
  const bool plain = !keys.has_water_data() && std::holds_alternative<ocean::MunkProfile>(environment.water) && !keys.bathymetry &&
                     environment.sediment_stations.empty();
  if (!plain)
    table.problem("members", "are drawn from an ocean with a Munk profile, flat and the same everywhere; list others as [[oceans]]");
  if (plain && !(std::get<ocean::MunkProfile>(environment.water).axis_depth.value > 0.0)) {
    table.problem("members", "are drawn from an ocean whose water.axis_depth_m is above 0: their scale keeps its ratio to it");
  }
  if (family.sea_floor_depth_m && !(family.sea_floor_depth_m->lowest > environment.source.depth.value)) {
    table.problem("sea_floor_depth_m", "must be more than source.depth_m");
  }
  return family;
}

ScenarioKeys read_scenario_keys(const host::TomlFile& file, TableReader& root, const ocean::EnvironmentKeys& environment) {
  ScenarioKeys keys;
  if (const auto conditions = root.optional_table("conditions")) keys.conditions = read_conditions(*conditions);
  if (const auto family = root.optional_table("family")) keys.family = read_own_family(*family, environment);
  if (root.has("oceans")) {
    for (TableReader& ocean : root.tables("oceans", kMostOceans))
      keys.other_oceans.push_back({.place = ocean.place_of("environment"), .file = file.resolve(ocean.text("environment"))});
  }
  if (auto library = root.optional_table("field_library")) keys.field_library = file.resolve(library->text("file"));
  if (!keys.field_library.empty() && (keys.family || !keys.other_oceans.empty())) {
    root.problem("field_library", "cannot be there with family or oceans");
  }
  return keys;
}

FileKeys read_keys(const host::TomlFile& file) {
  FileKeys keys;
  const auto further = [&keys](const host::TomlFile& read, TableReader& root, const ocean::EnvironmentKeys& environment) {
    keys.scenario = read_scenario_keys(read, root, environment);
  };
  keys.environment = ocean::read_environment_keys(file, further);
  return keys;
}

/// What is wrong with it is wrong with the file that names it, too.
ocean::Environment load_other_ocean(const OtherOcean& other) {
  try {
    const FileKeys keys = read_keys(host::TomlFile(other.file));
    if (!keys.scenario.is_one_ocean()) throw BadInput(other.file.string() + ": must be one ocean without conditions");
    return ocean::environment_of(other.file, keys.environment);
  } catch (const BadInput& bad) {
    throw BadInput(other.place + ": " + bad.what());
  }
}

}  // namespace

Scenario load_scenario(const std::filesystem::path& path, const std::string& option) {
  const host::TomlFile file(path);
  require_kind(option, file, FileKind::kEnvironment);
  const FileKeys keys = read_keys(file);
  Scenario scenario{.environment = ocean::environment_of(path, keys.environment),
                    .field_library = keys.scenario.field_library,
                    .conditions = keys.scenario.conditions};
  std::uint32_t& crc = scenario.environment.file_crc32;
  std::vector<std::filesystem::path>& files = scenario.environment.files;
  if (keys.scenario.family) scenario.other_oceans = draw_family(scenario.environment, *keys.scenario.family);
  if (std::filesystem::exists(scenario.field_library)) {  // whoever needs it says when it is not there
    field_library::require_library(scenario.field_library);
    crc = host::crc32_of_file(scenario.field_library, crc);
    files.push_back(scenario.field_library);
  }
  for (const OtherOcean& other : keys.scenario.other_oceans) {
    scenario.other_oceans.push_back(load_other_ocean(other));
    crc = crc32_of(scenario.other_oceans.back().file_crc32, crc);
    files.insert(files.end(), scenario.other_oceans.back().files.begin(), scenario.other_oceans.back().files.end());
  }
  return scenario;
}

}  // namespace earshot::search
