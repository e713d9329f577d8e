#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "policy/ppo/checkpoint/checkpoint.hpp"
#include "policy/training/learning_curve.hpp"

namespace earshot::training {

/// The file of updates beside a curve of episodes: "a.csv" -> "a.updates.csv"
[[nodiscard]] std::filesystem::path updates_of(std::filesystem::path curve);

/// The curve of a checkpoint for which none is named: "a.checkpoint" -> "a.csv"
[[nodiscard]] std::filesystem::path curve_beside(std::filesystem::path checkpoint);

/// "a.checkpoint" -> "a.seed3.checkpoint"
[[nodiscard]] std::filesystem::path with_seed(const std::filesystem::path& path, std::uint64_t seed);

/// A curve's place as its checkpoint keeps it: so that both can be moved together, and copied under another name where one is the other's.
/// Empty: beside the checkpoint under its name; else relative to the checkpoint's folder where it lies below that, else absolute.
[[nodiscard]] std::string place_to_record(const std::filesystem::path& curve, const std::filesystem::path& checkpoint);

/// What a checkpoint keeps of a curve's text, so that the same beginning is found in the file again.
[[nodiscard]] ppo::Continuation::Written written(const std::string& text);

/// The curve up to a checkpoint: of its two files, the beginnings that stood there when the checkpoint was written.
/// @param curve  the file of episodes. Throws host::BadInput when a file is shorter, or begins otherwise.
[[nodiscard]] LearningCurve earlier_curve(const std::filesystem::path& curve, const ppo::Continuation& continuation);

}  // namespace earshot::training
