#pragma once

#include <string_view>
#include <utility>
#include <vector>

#include "firmware/host/toml/table_reader.hpp"
#include "sim/search/episode/episode.hpp"

namespace earshot::ppo {

/// The reward that training learns from. The search's own reward (sim/search) stays what evaluation and flights count.
///
///   r' = scale (max(r, least) + step + found [the step finds the source])
///
/// A new term of it goes here: as a member, into of(), read_training_reward() and describe(); its key into the run file that names every
/// key (runs/fixed_source.toml). A term on more than reward and end (turning, distance) needs what it looks at from the caller,
/// trainer.cpp. Oracle: TrainingReward.*, TrainerTest.TellsLearningTheRewardsOfTheRunFileBesideThePapers
struct TrainingReward {
  double found = 0.0;     ///< added to the reward of the step that finds the source: the paper's reward has no such term
  double step = 0.0;      ///< added to the reward of every step
  double least = -1.0e9;  ///< a step earns no less: a deep border must not drown everything else
  double scale = 1.0;     ///< > 0

  /// @param reward  r, the search's own reward of a step
  /// @param end     of the episode, after that step
  [[nodiscard]] float of(float reward, search::EpisodeEnd end) const;
};

/// Reads [training_reward] of a run file: its keys `found`, `step` and `least`. (`scale` is `reward_scale` of [ppo].)
void read_training_reward(host::TableReader table, TrainingReward& reward);

/// The terms as provenance has them, in its order.
[[nodiscard]] std::vector<std::pair<std::string_view, double>> describe(const TrainingReward& reward);

}  // namespace earshot::ppo
