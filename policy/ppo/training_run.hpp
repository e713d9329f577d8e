#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "firmware/core/units.hpp"
#include "firmware/policy/observation.hpp"
#include "policy/description/state.hpp"
#include "policy/ppo/hyper_parameters.hpp"
#include "sim/search/settings.hpp"

namespace earshot::ppo {

enum class LearningRateSchedule : std::uint8_t {
  kConstant,
  kLinear,  ///< falls to zero with the last of `steps`
};

/// Where a run file has the vehicle start.
enum class Start : std::uint8_t {
  kRegion,        ///< in search.start_region, whatever else is settled
  kInsideBorder,  ///< where the border costs nothing: search.start_region moves with search.border_width
};

/// Everything that decides what a training run makes.
struct TrainingRun {
  std::filesystem::path environment;  ///< environment file; its source position is the fixed source
  /// World files, and folders of them: every episode is in one of these worlds; none: in the environment's own ocean and conditions.
  std::vector<std::filesystem::path> worlds = {};
  /// Ocean tables, and folders of them, of which one is searched by; none: by the environment's own ocean alone.
  std::vector<std::filesystem::path> tables = {};
  Meters vehicle_depth{300.0};  ///< of the hydrophone, > 0
  search::SearchSettings search;
  Start start = Start::kRegion;
  description::State state = description::State::kSimple;
  std::size_t remembered_steps = 2;  ///< m of the memory states, 1 to description::most_remembered(state)
  HyperParameters hyper;
  LearningRateSchedule learning_rate_schedule = LearningRateSchedule::kConstant;
  std::uint64_t seed = 1;
  std::uint64_t episodes = 0;  ///< training ends with the rollout that brings the last of so many; 0: no limit
  std::uint64_t steps = 0;     ///< training ends with the rollout that reaches it; 0: no limit
};

/// Episodes stepped together: each has a belief of up to 260 KiB.
inline constexpr std::int64_t kMostEnvironments = 8192;

/// A setting that is right by itself and does not fit the others.
struct Mismatch {
  const char* key = nullptr;  ///< null: all fit
  std::string what = {};      ///< what it must be
};

/// A rollout must be one that memory can hold, and no smaller than a batch. Oracle: TrainingRun.RefusesABatchLargerThanTheRollout
[[nodiscard]] Mismatch mismatch_of(const HyperParameters& hyper);

/// Reads a run file: the keys of `policy/ppo/runs/fixed_source.toml`, all of them optional. Throws host::BadInput with every
/// problem.
[[nodiscard]] TrainingRun load_run(const std::filesystem::path& path);

/// What the policy of this run sees, and what it takes for granted when it looks.
[[nodiscard]] policy::ObservationModel observation_of(const TrainingRun& run);

inline constexpr std::string_view kDecayStepsName = "learning_rate_decay_steps";

/// Every setting that shaped the policy, as names and values, for its provenance. Numbers are written with six digits, or as many more
/// as it takes to read back the same. Oracle: TrainingRun.DescribesNumbersSoThatTheyReadBackTheSame
[[nodiscard]] std::vector<std::pair<std::string, std::string>> describe(const TrainingRun& run);

}  // namespace earshot::ppo
