#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "firmware/policy/tables/ocean_tables.hpp"
#include "sim/search/scenario/scenario.hpp"
#include "sim/search/settings.hpp"

namespace earshot::evaluate {

/// What a world file says: a scenario to test policies in.
struct WorldFile {
  std::string name;
  std::string what;  ///< in one line
  std::uint64_t seed = 1;
  std::optional<Meters> vehicle_depth = {};  ///< > 0, in the water; absent: whoever searches says it
  search::Scenario scenario;
  std::filesystem::path environment = {};  ///< the file that the scenario was read from
};

/// Reads a world: keys name, what, seed, environment (a file), and optionally vehicle_depth_m, above 0 and above the sea floor at the
/// source, and [conditions], which then replace the environment's own. Throws host::BadInput with everything that is wrong.
[[nodiscard]] WorldFile load_world(const std::filesystem::path& path);

/// The file of a world that ships, by its name ("rock"), or by that of the file; empty where none is of that name.
[[nodiscard]] std::filesystem::path shipped_world(const std::string& name);

/// The world files of a folder, by name. Throws host::BadInput when there are none.
[[nodiscard]] std::vector<std::filesystem::path> worlds_in(const std::filesystem::path& folder);

/// What is listened for in a world. @param world  knows how deep its vehicle is
[[nodiscard]] policy::SearchedSound sound_of(const WorldFile& world, const search::SearchSettings& settings);

}  // namespace earshot::evaluate
