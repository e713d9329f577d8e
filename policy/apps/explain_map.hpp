#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "firmware/core/geometry.hpp"

namespace earshot::apps {

struct ExplainMapOptions {
  std::filesystem::path policy;
  std::optional<std::string> source;  ///< "NORTH_M,EAST_M" from the south-west corner of the policy's area
  std::optional<std::filesystem::path> environment;
  std::optional<std::filesystem::path> world;  ///< a world of policy/worlds, instead of an environment
  double vehicle_depth_m = 300.0;
  std::optional<std::filesystem::path> flight;
  std::uint32_t step = 0;
  std::size_t arrows = 25;  ///< along a side
  std::size_t starts = 6;   ///< along a side, of a policy that goes by what it has heard
  std::filesystem::path output;
  bool force = false;  ///< replace whatever file is there
};

/// Draws what a policy would do all over its area. Throws host::BadInput.
void draw_explanation_map(const ExplainMapOptions& options);

/// Reads "NORTH_M,EAST_M": metres, or each with its unit ("10km,9500m"). Throws host::BadInput naming the option when it is anything
/// else, and when both numbers are below 100 without a unit: whoever writes 10,10 means kilometres more often than a place beside the
/// origin. 0,0 is the same in both.
[[nodiscard]] NorthEast north_east_of(const std::string& option, const std::string& text);

}  // namespace earshot::apps
