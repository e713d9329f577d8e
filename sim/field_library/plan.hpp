#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "firmware/core/geometry.hpp"
#include "sim/ocean/environment.hpp"
#include "sim/sonar/fan.hpp"

namespace earshot::field_library {

/// What stands in the middle of each fan.
enum class Centre : std::uint8_t {
  kSource,
  kHydrophone,  ///< by reciprocity: one march per radial for every source depth around the hydrophone
};

/// From the origin, north and east: a plane that reaches further is none on this earth.
inline constexpr double kFurthestPosition_m = 1e6;

inline constexpr std::size_t kMostPositions = 1'000'000;
inline constexpr std::size_t kMostFrequencies = 10'000;

/// Fans around many positions of one region.
struct LibraryPlan {
  std::string name;
  ocean::Environment environment;
  std::vector<NorthEast> positions;
  Centre centre;
  sonar::FanPlan fan;
  std::uint32_t file_crc32;  ///< of the file it was read from
};

/// Who reads the environment file that a library names: `ocean::load_environment`, or a reader of files that say more than the ocean.
using EnvironmentReader = std::function<ocean::Environment(const std::filesystem::path&)>;

/// Reads a library's TOML file; README.md lists its keys. The environment that it names is read too.
///
/// Throws host::BadInput with what is wrong, one line each.
/// Oracle: LibraryPlan.*
[[nodiscard]] LibraryPlan load_library_plan(const std::filesystem::path& path, const EnvironmentReader& read_environment);

/// Whether the march can begin, for each position: not on land, and the sea floor lies below its depth.
///
/// Throws host::BadInput for a position off the chart, for one whose radials leave it (looked for on eight bearings), and when no
/// position is in the water.
[[nodiscard]] std::vector<bool> positions_in_water(const LibraryPlan& plan);

/// The thickest water that was not measured but extended, on eight bearings of every position, if any.
[[nodiscard]] std::optional<ocean::UnmeasuredWater> unmeasured_water(const LibraryPlan& plan);

}  // namespace earshot::field_library
