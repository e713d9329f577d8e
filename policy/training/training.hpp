#pragma once

#include <atomic>
#include <cstdint>
#include <memory>

#include "firmware/host/file/distinct_files.hpp"
#include "policy/ppo/training_run.hpp"
#include "policy/training/job.hpp"
#include "policy/training/learning_curve.hpp"
#include "policy/training/progress.hpp"
#include "sim/parallel/ranks.hpp"

namespace earshot::training {

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

  /// The files that it has read: its environment, worlds and ocean tables.
  void add_to(host::DistinctFiles& read) const;
  [[nodiscard]] const TrainingJob& job() const;
  [[nodiscard]] const ppo::TrainingRun& run_settings() const;
  [[nodiscard]] const LearningCurve& curve() const;
  [[nodiscard]] std::uint64_t steps() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace earshot::training
