#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "policy/description/search_description.hpp"
#include "policy/ppo/actor_critic.hpp"
#include "policy/ppo/trainer.hpp"

namespace earshot::ppo {

/// Everything that a program needs to go on with a training that was interrupted.
struct Continuation {
  TrainingState state;
  std::vector<std::string> arguments;  ///< command line that began the training, without the program's name
  std::string directory;               ///< where it was given
  std::uint32_t settings_crc32 = 0;    ///< of all settings and files that shape the training
  /// The curves up to here: what is left of their files was written later and is dropped.
  struct Written {
    std::size_t bytes = 0;
    std::uint32_t crc32 = 0;
  };
  Written episodes;
  Written updates;
  /// The path of the curve of episodes, from the checkpoint's folder; empty: beside it, under its name with .csv.
  /// None: written by a program that did not say so.
  std::optional<std::string> curve = {};
};

/// The result of training: both networks, and what they see and do.
struct Checkpoint : description::SearchDescription {
  std::vector<float> parameters;  ///< as ActorCritic::parameters() of shape()

  std::optional<Continuation> continuation = {};  ///< none: made elsewhere, cannot be gone on with

  [[nodiscard]] NetworkShape shape() const {
    return {static_cast<Eigen::Index>(observation.spec.size()), static_cast<Eigen::Index>(direction_count)};
  }
};

/// The text of a checkpoint file: one line of JSON, in which floats survive exactly, and one with the CRC-32 of the first.
[[nodiscard]] std::string to_text(const Checkpoint& checkpoint);

/// Reads a checkpoint's text. Throws host::BadInput, naming `file`, when it is cut short or damaged, of another
/// version, or does not fit together.
[[nodiscard]] Checkpoint from_text(std::string_view text, const std::string& file);

}  // namespace earshot::ppo
