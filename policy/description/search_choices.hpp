#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "policy/description/trained_task.hpp"
#include "sim/search/settings.hpp"

namespace earshot::description {

/// What a person may choose of a search; what is not given leaves the settings as they are.
struct SearchChoices {
  std::optional<double> vehicle_depth_m = {};
  std::optional<std::string> source = {};  ///< one of search::kPlacements
  std::optional<std::string> start = {};   ///< one of search::kStartPlacements
  std::optional<double> start_margin_m = {};
  std::optional<double> border_width_m = {};
  std::optional<std::uint32_t> max_steps = {};
};

/// The choices that were made, and where one was not what a policy was trained for, if that is known: source, starts, border's width,
/// steps, depth. Starts that are not known lie inside the border. The environment stays: a policy is tested in other oceans than it learned
/// in. Oracle: SearchChoicesTest.*
[[nodiscard]] SearchChoices with_trained(SearchChoices given, const TrainedTask& task);

/// Settings as chosen, but for the vehicle's depth, which they do not hold.
/// @return false where nothing of the domain is left to start in, or all of it lies within a step of the source
[[nodiscard]] bool apply(const SearchChoices& choices, search::SearchSettings& settings);

}  // namespace earshot::description
