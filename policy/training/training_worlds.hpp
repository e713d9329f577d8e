#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <vector>

#include "firmware/core/units.hpp"
#include "policy/evaluate/world_file.hpp"
#include "sim/search/scenario/world.hpp"

namespace earshot::training {

/// The worlds that the episodes of a training are drawn from.
struct TrainingWorlds {
  std::vector<search::World> worlds = {};
  std::uint32_t crc32 = 0;                        ///< of all that their files say, and of the files that those name
  std::vector<std::filesystem::path> files = {};  ///< their files, and those that these name
};

/// What is heard in every world of a training: a policy knows one depth and one frequency.
struct Listening {
  Meters vehicle_depth;  ///< also of the vehicle in a world that names none
  Hertz frequency;       ///< of the source
};

/// The files that are named, and the *.toml of the folders that are, by name. Throws host::BadInput for a folder without any and for a
/// file that comes twice.
[[nodiscard]] std::vector<std::filesystem::path> world_files(std::span<const std::filesystem::path> named);

/// Throws host::BadInput for a world where nothing may learn: one of policy/worlds, or of the generator's splits validation and test; and
/// for one whose depth of the vehicle or frequency of the source differs from the training's by more than ocean tables allow.
void check_trainable(const evaluate::WorldFile& world, const std::filesystem::path& path, const Listening& listening);

/// Reads the worlds and computes what is heard in each.
///
/// @param settings  of a search in any of them
/// @param threads   that compute, >= 1
/// @param done      called with the share of them that is done, 0 to 1
/// Throws host::BadInput with the name of the world's file; before anything is computed, where one of them cannot be read.
/// Oracle: TrainingWorldsTest.*
[[nodiscard]] TrainingWorlds load_worlds(std::span<const std::filesystem::path> named, const search::SearchSettings& settings,
                                         const Listening& listening, std::size_t threads, const std::function<void(double)>& done);

}  // namespace earshot::training
