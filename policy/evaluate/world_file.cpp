#include "policy/evaluate/world_file.hpp"

#include <algorithm>
#include <limits>
#include <optional>
#include <sstream>

#include "firmware/host/file/shipped.hpp"
#include "firmware/host/toml/table_reader.hpp"
#include "sim/search/scenario/conditions_table.hpp"
#include "sim/search/scenario/file_kind.hpp"
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

/// A bare name is told which file it is the name of.
void require_there(const std::filesystem::path& path) {
  if (std::filesystem::exists(path)) return;
  const std::filesystem::path ships = shipped_world(path.string());
  throw host::BadInput(path.string() + ": no such file" + (ships.empty() ? "" : "; the world that ships is " + ships.string()));
}

}  // namespace

std::filesystem::path shipped_world(const std::string& name) try {
  if (name.find('/') != std::string::npos) return {};
  const std::filesystem::path folder = host::shipped("policy/worlds");
  for (const std::filesystem::path& file : {folder / (name + ".toml"), folder / name}) {
    if (!name.empty() && std::filesystem::is_regular_file(file)) return file;
  }
  return {};
} catch (const host::BadInput&) {  // an installation without them
  return {};
}

WorldFile load_world(const std::filesystem::path& path) {
  require_there(path);
  const host::TomlFile file(path);
  search::require_kind("--world", file, search::FileKind::kWorld);
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

policy::SearchedSound sound_of(const WorldFile& world, const search::SearchSettings& settings) {
  return {.vehicle_depth = world.vehicle_depth.value(),
          .frequency = world.scenario.environment.source.frequency,
          .furthest = range_between(settings.domain.south_west, settings.domain.north_east)};
}

}  // namespace earshot::evaluate
