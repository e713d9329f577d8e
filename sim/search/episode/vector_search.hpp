#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "sim/search/episode/episode.hpp"

namespace earshot::search {

/// An episode under way: what to do over again to stand where it stands, whatever it consists of.
struct EpisodeScript {
  Pcg32::State random;                ///< before the episode's start was drawn
  std::vector<std::uint8_t> actions;  ///< since then
  friend bool operator==(const EpisodeScript&, const EpisodeScript&) = default;
};

/// Many independent episodes stepped together, for training. A finished episode starts anew within the same step (Stable-Baselines3's
/// autoreset): observations() then shows the new episode's first observation, final_observation() the old one's last.
/// Nothing is allocated after construction, unless an episode is longer than 1024 steps. Environment i draws from training_random
/// first_stream + i of the seed (streams.hpp), so its episodes do not depend on how many others run. Where there are several worlds it
/// draws the one that an episode is in, each as likely as another, before the episode's start; where there is one it draws nothing for it.
class VectorSearch {
 public:
  /// @param world, tables  outlive this; check(world.settings) is kOk
  /// @param first_stream  of the seed, that of environment 0: other processes have those before and after
  VectorSearch(const World& world, const policy::ObservationModel& model, const policy::OceanTables& tables, std::size_t environment_count,
               std::uint64_t seed, std::uint64_t first_stream = 0);
  /// @param worlds  at least one; they and the tables outlive this; their settings are the same
  VectorSearch(std::span<const World> worlds, const policy::ObservationModel& model, const policy::OceanTables& tables,
               std::size_t environment_count, std::uint64_t seed, std::uint64_t first_stream = 0);

  VectorSearch(const VectorSearch&) = delete;  // its episodes point to its model
  VectorSearch& operator=(const VectorSearch&) = delete;

  /// One action for each environment.
  void step(std::span<const std::size_t> actions);

  /// What brings every episode back, environment 0 first.
  [[nodiscard]] const std::vector<EpisodeScript>& scripts() const { return scripts_; }
  /// Goes on from there, bit for bit. False when they are not scripts of episodes under way in this world; only good for destruction then.
  /// Oracle: VectorSearchTest.GoesOnFromItsScriptsAsIfNothingHadHappened
  [[nodiscard]] bool resume(std::span<const EpisodeScript> scripts);

  [[nodiscard]] std::size_t environment_count() const { return episodes_.size(); }
  [[nodiscard]] std::size_t observation_size() const { return model_.spec.size(); }
  [[nodiscard]] std::size_t action_count() const { return worlds_.front().actions.size(); }
  /// The number of the world that an environment's episode is in.
  [[nodiscard]] std::size_t world_of(std::size_t environment) const { return drawn_worlds_[environment]; }

  /// [observation_size] of one environment, to act upon next.
  [[nodiscard]] std::span<const float> observation(std::size_t environment) const;
  /// [observation_size] at the end of the episode that the last step ended; meaningful only where ended(i).end is not kRunning.
  [[nodiscard]] std::span<const float> final_observation(std::size_t environment) const;
  [[nodiscard]] float reward(std::size_t environment) const { return rewards_[environment]; }
  /// The episode that the last step ended; end is kRunning where it goes on.
  [[nodiscard]] const EpisodeRecord& ended(std::size_t environment) const { return ended_[environment]; }

 private:
  void start(std::size_t environment);
  double take(std::size_t environment, std::size_t action);
  [[nodiscard]] std::span<float> slot(std::vector<float>& all, std::size_t environment) const;

  std::span<const World> worlds_;
  policy::ObservationModel model_;
  const policy::OceanTables& tables_;
  std::vector<Episode> episodes_;
  std::vector<std::size_t> drawn_worlds_;  // of the episodes
  std::vector<Pcg32> random_;
  std::vector<EpisodeScript> scripts_;
  std::vector<float> observations_;        // [environment_count x observation_size]
  std::vector<float> final_observations_;  // [environment_count x observation_size]
  std::vector<float> rewards_;
  std::vector<EpisodeRecord> ended_;
};

}  // namespace earshot::search
