#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "firmware/host/toml/table_reader.hpp"
#include "sim/ocean/environment.hpp"

namespace earshot::search {

/// A number is drawn uniformly between these.
struct Bounds {
  double lowest;
  double highest;
};

/// Oceans like the environment file's own, some of their numbers drawn anew; what has no bounds stays as it is.
struct Family {
  std::size_t members;  ///< >= 1
  std::uint64_t seed;
  std::optional<Bounds> sea_floor_depth_m = {};
  std::optional<Bounds> axis_depth_m = {};              ///< of the Munk profile; its scale keeps the ratio to it
  std::optional<Bounds> perturbation = {};              ///< of the Munk profile
  std::optional<Bounds> sediment_sound_speed_mps = {};  ///< of the half-space
  std::optional<Bounds> noise_level_db_re_1upa = {};
};

/// The table [family] of an environment file.
[[nodiscard]] Family read_family(host::TableReader table);

/// The members. @param own  with a Munk profile whose axis is deeper than 0, the same everywhere
[[nodiscard]] std::vector<ocean::Environment> draw_family(const ocean::Environment& own, const Family& family);

}  // namespace earshot::search
