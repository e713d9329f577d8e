#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace earshot::report {

struct PolicyMapOptions {
  std::filesystem::path policy;
  std::optional<std::string> source;  ///< "NORTH_M,EAST_M" from the south-west corner of the policy's area
  std::optional<std::filesystem::path> environment;
  std::optional<std::filesystem::path> world;  ///< a world of policy/worlds, instead of an environment
  std::filesystem::path tables;                ///< of a policy with a belief; a flight has its own
  double vehicle_depth_m = 300.0;
  std::optional<std::filesystem::path> flight;
  std::uint32_t step = 0;
  std::size_t arrows = 25;  ///< along a side
  std::size_t starts = 6;   ///< along a side, of a policy that goes by what it has heard
  std::filesystem::path output;
  bool force = false;  ///< replace whatever file is there
};

/// Draws what a policy would do all over its area. Throws host::BadInput.
void draw_policy_map(const PolicyMapOptions& options);

}  // namespace earshot::report
