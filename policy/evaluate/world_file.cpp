#include "policy/evaluate/world_file.hpp"

#include <algorithm>
#include <limits>
#include <optional>

#include "firmware/host/toml/table_reader.hpp"
#include "sim/search/scenario/conditions_table.hpp"
#include "sim/search/scenario/scenario_file.hpp"

namespace earshot::evaluate {

WorldFile load_world(const std::filesystem::path& path) {
  const host::TomlFile file(path);
  host::TableReader root = file.root();
  WorldFile world{.name = root.text("name"), .what = root.text("what"), .scenario = {}};
  world.seed = static_cast<std::uint64_t>(root.integer("seed", 0, std::numeric_limits<std::int64_t>::max()));
  const std::filesystem::path environment = file.resolve(root.text("environment"));
  std::optional<search::Conditions> conditions;
  if (const auto table = root.optional_table("conditions")) conditions = search::read_conditions(*table);
  file.finish();
  world.scenario = search::load_scenario(environment);
  if (conditions) world.scenario.conditions = *conditions;
  return world;
}

std::vector<std::filesystem::path> worlds_in(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> paths;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error)) {
    if (entry.path().extension() == ".toml") paths.push_back(entry.path());
  }
  if (paths.empty()) throw host::BadInput(folder.string() + ": no worlds (*.toml) there");
  std::ranges::sort(paths);
  return paths;
}

}  // namespace earshot::evaluate
