#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "firmware/host/file/distinct_files.hpp"
#include "firmware/host/file/output_file.hpp"
#include "policy/ppo/checkpoint/checkpoint.hpp"
#include "policy/training/options.hpp"

namespace earshot::training {

inline constexpr host::OutputKind kCheckpointOutput{"a checkpoint of earshot train", {R"({"format":"earshot checkpoint)", {}}};
inline constexpr host::OutputKind kCurveOutput{"a learning curve (CSV)", {"episode,", {}}};
inline constexpr host::OutputKind kLossesOutput{"the losses of a training (CSV)", {"steps,episodes,", {}}};

/// One training from its first step, or from a checkpoint, to its last: a checkpoint and two curves.
struct TrainingJob {
  TrainOptions options;                         ///< of one seed
  std::filesystem::path output;                 ///< checkpoint
  std::filesystem::path curve;                  ///< a row an episode
  std::filesystem::path updates;                ///< a row an update, beside the curve
  std::filesystem::path earlier_curve = {};     ///< the curve up to the checkpoint that is resumed, its updates beside it
  std::vector<std::string> arguments;           ///< command line that begins it, without the program's name
  std::filesystem::path directory;              ///< where that was given
  std::filesystem::path resumed_file = {};      ///< checkpoint that it goes on from
  std::optional<ppo::Checkpoint> resumed = {};  ///< its content, whose continuation is not empty
};

/// The files that jobs write: none may be another, nor a file that a job reads. Throws host::BadInput.
/// @param given  the command line of all of them
[[nodiscard]] host::DistinctFiles files_of(const std::vector<TrainingJob>& jobs, const TrainOptions& given);

/// The jobs that a command line asks for. Throws host::BadInput, also when two of their files are one.
/// @param arguments  the command line without the program's name
[[nodiscard]] std::vector<TrainingJob> jobs_of(const TrainOptions& options, const std::vector<std::string>& arguments);

}  // namespace earshot::training
