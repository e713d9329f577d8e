#include "policy/evaluate/world_file.hpp"

#include <algorithm>
#include <limits>
#include <optional>
#include <sstream>

#include "firmware/host/toml/table_reader.hpp"
#include "sim/search/scenario/conditions_table.hpp"
#include "sim/search/scenario/scenario_file.hpp"

namespace earshot::evaluate {
namespace {

void check_depth(const host::TableReader& root, const WorldFile& world, const std::filesystem::path& environment) {
  const Meters floor = world.scenario.environment.seabed.depth;
  if (!world.vehicle_depth || *world.vehicle_depth < floor) return;
  std::ostringstream text;
  text << root.place_of("vehicle_depth_m") << ": " << world.vehicle_depth->value << " must be less than the depth of the sea floor in "
       << environment.string() << ", " << floor.value << " m";
  throw host::BadInput(text.str());
}

}  // namespace

WorldFile load_world(const std::filesystem::path& path) {
  const host::TomlFile file(path);
  host::TableReader root = file.root();
  WorldFile world{.name = root.text("name"), .what = root.text("what"), .scenario = {}};
  world.seed = static_cast<std::uint64_t>(root.integer("seed", 0, std::numeric_limits<std::int64_t>::max()));
  constexpr double kDeepest_m = 12'000.0;  // as a training run's
  if (root.has("vehicle_depth_m")) world.vehicle_depth = Meters{root.number("vehicle_depth_m", host::Range::above_up_to(0.0, kDeepest_m))};
  const std::filesystem::path environment = file.resolve(root.text("environment"));
  std::optional<search::Conditions> conditions;
  if (const auto table = root.optional_table("conditions")) conditions = search::read_conditions(*table);
  file.finish();
  world.environment = environment;
  world.scenario = search::load_scenario(environment);
  check_depth(root, world, environment);
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
