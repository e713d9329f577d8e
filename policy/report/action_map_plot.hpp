#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>

#include "policy/explain/action_map.hpp"
#include "policy/explain/decision_account.hpp"

namespace earshot::report {

/// What stands beside and under the arrows. Places are relative to the area's south-west corner.
struct ActionMapPicture {
  const policy::FrozenPolicy& policy;
  const explain::ActionMap& map;            ///< square
  std::function<double(NorthEast)> snr_db;  ///< heard at a place
  std::optional<NorthEast> source;
  std::string heard;                                      ///< over the SNR: whose ocean it is
  std::string what;                                       ///< over the arrows: "after a first look at each place"
  const explain::DecisionAccount* belief = nullptr;       ///< drawn under the arrows in place of the probability of the likeliest direction
  std::span<const explain::RecordedDecision> track = {};  ///< drawn with the belief
};

/// Two panels: the SNR over the policy's area, and the policy's mean direction on a grid, longer where its probabilities agree.
/// @param path  .png or .svg. Throws as sonar::draw does.
void draw_action_map(const std::filesystem::path& path, const ActionMapPicture& picture);

}  // namespace earshot::report
