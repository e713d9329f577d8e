#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "firmware/core/geometry.hpp"
#include "firmware/core/units.hpp"
#include "sim/search/scenario/placement.hpp"
#include "sim/search/settings.hpp"

namespace earshot::description {

/// What of a policy's training its provenance says, of that which the policy does not hold itself. Programs wrote more and more of it:
/// anything may be missing.
struct TrainedTask {
  std::optional<search::SourcePlacement> source = {};  ///< source
  std::optional<NorthEast> source_position = {};       ///< source_north_m, source_east_m: of a fixed source
  std::optional<search::StartPlacement> start = {};    ///< start: the region's name
  std::optional<Meters> start_margin = {};             ///< start_margin_m: of the starts from every edge
  std::optional<Meters> border_width = {};             ///< border_width_m
  std::optional<double> border_reward = {};            ///< border_reward
  std::optional<std::uint32_t> max_steps = {};         ///< max_steps
  std::optional<Meters> vehicle_depth = {};            ///< vehicle_depth_m
  std::string environment = {};                        ///< environment: the file's name; empty: not said
  std::string environment_crc32 = {};                  ///< environment_crc32: of that file and all that it names; empty: not said
};

/// Reads the lines of those names. A line whose value is none that the name can have says nothing.
/// @param provenance  lines "name = value"
/// Oracle: TrainedTask.* in tests/policy/description
[[nodiscard]] TrainedTask trained_task(std::string_view provenance);

/// Lines of a provenance: names and values.
using Lines = std::vector<std::pair<std::string, std::string>>;

/// Where a fixed source stands; no line of a changing one.
[[nodiscard]] Lines source_place_lines(const search::SearchSettings& settings);

/// What trained_task() reads, but the environment. Numbers as short as they read back the same.
[[nodiscard]] Lines task_lines(const search::SearchSettings& settings, Meters vehicle_depth);

}  // namespace earshot::description
