#include "policy/training/training_worlds.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>

#include "firmware/host/file/bad_input.hpp"
#include "firmware/host/file/checksum_text.hpp"
#include "firmware/host/file/input_file.hpp"
#include "firmware/host/file/shipped.hpp"
#include "firmware/policy/tables/ocean_tables.hpp"
#include "policy/command_line/scenario_options.hpp"
#include "sim/parallel/ordered_tasks.hpp"

namespace earshot::training {
namespace {

namespace fs = std::filesystem;
using host::BadInput;

/// Seeds of the splits validation and test of policy/worlds/generator (FIRST_SEED in generate.py).
constexpr std::uint64_t kFirstHeldOutSeed = 2'000'000;
constexpr std::uint64_t kBehindHeldOutSeeds = 4'000'000;

bool is_beneath(const fs::path& path, const fs::path& folder) {
  std::error_code error;
  const fs::path relative = fs::weakly_canonical(path, error).lexically_relative(fs::weakly_canonical(folder, error));
  return !relative.empty() && *relative.begin() != "..";
}

/// Whether a number lies within that share of another.
bool is_near(double number, double of, double share) {
  return std::abs(number - of) <= share * of;
}

void check_alike(const fs::path& path, std::string_view key, double number, double of, double share) {
  if (is_near(number, of, share)) return;
  std::ostringstream text;
  text << path.string() << ": " << key << ": " << number << ", where this training has " << of << ": must be within " << 100.0 * share
       << " % of it";
  throw BadInput(text.str());
}

Meters depth_in(const evaluate::WorldFile& world, const Listening& listening) {
  return world.vehicle_depth.value_or(listening.vehicle_depth);
}

search::World assembled(const evaluate::WorldFile& world, const fs::path& path, const search::SearchSettings& settings,
                        const Listening& listening) {
  try {
    return search::assemble(world.scenario, settings, depth_in(world, listening));
  } catch (const std::runtime_error& e) {
    throw BadInput(path.string() + ": " + e.what());
  } catch (const std::invalid_argument& e) {
    throw BadInput(path.string() + ": " + e.what());
  }
}

}  // namespace

std::vector<fs::path> world_files(std::span<const fs::path> named) {
  std::vector<fs::path> files;
  for (const fs::path& path : named) {
    std::error_code error;
    if (!fs::is_directory(path, error)) {
      files.push_back(path);
      continue;
    }
    const std::vector<fs::path> in_folder = evaluate::worlds_in(path);
    files.insert(files.end(), in_folder.begin(), in_folder.end());
  }
  std::set<fs::path> seen;
  for (const fs::path& file : files) {
    std::error_code error;
    if (!seen.insert(fs::weakly_canonical(file, error)).second)
      throw BadInput("--world, worlds: " + file.string() + " is named twice: it would be drawn twice as often");
  }
  return files;
}

void check_trainable(const evaluate::WorldFile& world, const fs::path& path, const Listening& listening) {
  const bool is_held_out = world.seed >= kFirstHeldOutSeed && world.seed < kBehindHeldOutSeeds;
  if (is_held_out || is_beneath(path, host::shipped("policy/worlds")))
    throw BadInput(path.string() + ": is a world that policies are judged in: none may learn there; policy/worlds/generate draws others");
  check_alike(path, "vehicle_depth_m", depth_in(world, listening).value, listening.vehicle_depth.value, policy::kDepthTolerance);
  check_alike(path, "source.frequency_hz of its environment", world.scenario.environment.source.frequency.value, listening.frequency.value,
              policy::kFrequencyTolerance);
  command_line::check_vehicle_depth(world.scenario.environment, path, depth_in(world, listening));
}

TrainingWorlds load_worlds(std::span<const fs::path> named, const search::SearchSettings& settings, const Listening& listening,
                           std::size_t threads, const std::function<void(double)>& done) {
  const std::vector<fs::path> files = world_files(named);
  std::vector<evaluate::WorldFile> worlds;
  std::ostringstream all;
  for (const fs::path& file : files) {
    worlds.push_back(evaluate::load_world(file));
    check_trainable(worlds.back(), file, listening);
    all << host::read_text(file, host::kTomlFile) << worlds.back().scenario.environment.file_crc32 << '\n';
  }
  std::vector<std::optional<search::World>> computed(worlds.size());
  const auto compute = [&](std::size_t i) { computed[i] = assembled(worlds[i], files[i], settings, listening); };
  const auto finished = [&](std::size_t i) { done(static_cast<double>(i + 1) / static_cast<double>(worlds.size())); };
  parallel::run_in_order({.groups = worlds.size(), .tasks_per_group = 1, .threads = threads, .window = worlds.size()}, compute, finished);
  TrainingWorlds result{.crc32 = host::crc32_of(all.str()), .files = files};
  for (const evaluate::WorldFile& world : worlds) {
    const std::vector<fs::path>& named_there = world.scenario.environment.files;
    result.files.insert(result.files.end(), named_there.begin(), named_there.end());
  }
  for (std::optional<search::World>& world : computed) result.worlds.push_back(std::move(*world));
  return result;
}

}  // namespace earshot::training
