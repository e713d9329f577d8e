#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "firmware/core/geometry.hpp"
#include "firmware/core/units.hpp"
#include "firmware/policy/observation.hpp"
#include "policy/ppo/actor_critic.hpp"

namespace earshot::ppo {

/// What training leaves behind: both networks and what they mean.
struct Checkpoint {
  policy::ObservationModel observation;
  std::size_t direction_count = 0;  ///< actions: compass directions, clockwise from north
  Meters step_length;
  NorthEast area_size;                                          ///< of the domain trained in
  Decibels detection_threshold;                                 ///< DT of the reward
  std::vector<std::pair<std::string, std::string>> provenance;  ///< names and values in the order written
  std::vector<float> parameters;                                ///< as ActorCritic::parameters() of shape()

  [[nodiscard]] NetworkShape shape() const {
    return {static_cast<Eigen::Index>(observation.spec.size()), static_cast<Eigen::Index>(direction_count)};
  }
};

/// The text of a checkpoint file (JSON; floats survive exactly).
[[nodiscard]] std::string to_text(const Checkpoint& checkpoint);

/// Reads a checkpoint's text. Throws config_file::BadInput, naming `file`, when it is cut short, of another format, or does not fit
/// together.
[[nodiscard]] Checkpoint from_text(std::string_view text, const std::string& file);

}  // namespace earshot::ppo
