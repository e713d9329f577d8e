#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "sim/search/episode.hpp"

namespace earshot::search {

/// Many independent episodes stepped together, for training. A finished episode starts anew within the same step (Stable-Baselines3's
/// autoreset): observations() then shows the new episode's first observation, final_observation() the old one's last.
/// Nothing is allocated after construction. Environment i draws from stream i of the seed, so its episodes do not depend on how many others
/// run.
class VectorSearch {
 public:
  /// @param world  outlives this; check(world.settings) is kOk
  VectorSearch(const SearchWorld& world, const policy::ObservationModel& model, std::size_t environment_count, std::uint64_t seed);
  VectorSearch(const VectorSearch&) = delete;  // its episodes point to its model
  VectorSearch& operator=(const VectorSearch&) = delete;

  /// One action for each environment.
  void step(std::span<const std::size_t> actions);

  [[nodiscard]] std::size_t environment_count() const { return episodes_.size(); }
  [[nodiscard]] std::size_t observation_size() const { return model_.spec.size(); }
  [[nodiscard]] std::size_t action_count() const { return world_.actions.size(); }

  /// [observation_size] of one environment, to act upon next.
  [[nodiscard]] std::span<const float> observation(std::size_t environment) const;
  /// [observation_size] at the end of the episode that the last step ended; meaningful only where ended(i).end is not kRunning.
  [[nodiscard]] std::span<const float> final_observation(std::size_t environment) const;
  [[nodiscard]] float reward(std::size_t environment) const { return rewards_[environment]; }
  /// The episode that the last step ended; end is kRunning where it goes on.
  [[nodiscard]] const EpisodeRecord& ended(std::size_t environment) const { return ended_[environment]; }

 private:
  [[nodiscard]] std::span<float> slot(std::vector<float>& all, std::size_t environment) const;

  const SearchWorld& world_;
  policy::ObservationModel model_;
  std::vector<Episode> episodes_;
  std::vector<Pcg32> random_;
  std::vector<float> observations_;        // [environment_count x observation_size]
  std::vector<float> final_observations_;  // [environment_count x observation_size]
  std::vector<float> rewards_;
  std::vector<EpisodeRecord> ended_;
};

}  // namespace earshot::search
