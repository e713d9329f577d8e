#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>

#include "policy/explain/action_map.hpp"
#include "policy/explain/decision_account.hpp"
#include "policy/explain/flown_paths.hpp"
#include "sim/sonar/snr_curve.hpp"

namespace earshot::report {

/// The left panel of a picture of what a policy does, and its heading. Places are relative to the area's south-west corner.
struct MapOcean {
  const policy::FrozenPolicy& policy;
  std::string policy_name;  ///< over both panels, with the conditions
  const sonar::SnrCurve& curve;
  NorthEast heard_from;             ///< whence it sounds
  std::string words;                ///< whose ocean it is
  std::string conditions;           ///< frequency and depths, in the heading
  std::optional<NorthEast> source;  ///< marked, where one knows it
};

/// What a flight has heard and believes, drawn under the arrows.
struct MapFlight {
  const explain::DecisionAccount& belief;
  std::span<const explain::RecordedDecision> track;
};

/// Two panels: the SNR over the policy's area, and the policy's mean direction on a grid, longer where its probabilities agree, over the
/// probability of the likeliest direction or over a flight's belief.
/// @param path    .png or .svg. Throws as plot::draw does.
/// @param arrows  square
/// @param words   over the arrows
void draw_arrows(const std::filesystem::path& path, const MapOcean& ocean, const explain::ActionMap& arrows, const std::string& words,
                 const std::optional<MapFlight>& flight = std::nullopt);

/// Two panels: the SNR over the policy's area, and where the policy goes from all over it, coloured by the number of its steps.
/// @param path   .png or .svg. Throws as plot::draw does.
/// @param paths  of searches for `ocean.source`, at least one
void draw_paths(const std::filesystem::path& path, const MapOcean& ocean, std::span<const explain::FlownPath> paths);

/// "The source is found from 34 of 36 starts, after 3 to 31 steps (median 14); the area is left from 2"
[[nodiscard]] std::string paths_to_string(std::span<const explain::FlownPath> paths);

}  // namespace earshot::report
