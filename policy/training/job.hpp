#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "policy/ppo/checkpoint.hpp"
#include "policy/ppo/training_run.hpp"
#include "policy/training/learning_curve.hpp"
#include "policy/training/options.hpp"
#include "policy/training/progress.hpp"
#include "sim/parallel/ranks.hpp"

namespace earshot::training {

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

/// The jobs that a command line asks for. Throws host::BadInput, also when two of their files are one.
/// @param arguments  the command line without the program's name
[[nodiscard]] std::vector<TrainingJob> jobs_of(const TrainOptions& options, const std::vector<std::string>& arguments);

/// A training under way: world, networks, curve and settings of one job.
class Training {
 public:
  /// Everything that bad input can spoil. Throws host::BadInput. @param ranks  outlives this
  Training(TrainingJob job, parallel::Ranks& ranks);
  ~Training();
  Training(const Training&) = delete;
  Training& operator=(const Training&) = delete;

  /// Trains to the end, or to the rollout after which `interrupted` is set (on rank 0), and writes the files (rank 0 does).
  /// Throws host::BadInput, on every rank, when training diverges; the files then stay as they were last written.
  void run(TrainingProgress& progress, std::size_t number, const std::atomic<bool>& interrupted);

  [[nodiscard]] const TrainingJob& job() const;
  [[nodiscard]] const ppo::TrainingRun& run_settings() const;
  [[nodiscard]] const LearningCurve& curve() const;
  [[nodiscard]] std::uint64_t steps() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace earshot::training
