#pragma once

#include <cstdint>
#include <deque>
#include <span>
#include <string>
#include <string_view>

#include "policy/ppo/learner.hpp"
#include "sim/search/episode/episode.hpp"

namespace earshot::training {

inline constexpr std::size_t kRecentEpisodes = 50;  ///< that "recent" means: the paper's Fig. 5

/// How training went, as the CSV files that it leaves: a row an episode, a row an update. The files are its whole state.
class LearningCurve {
 public:
  LearningCurve();
  /// Goes on from what was written. Throws std::invalid_argument when `episodes_csv` is not its like.
  LearningCurve(std::string episodes_csv, std::string updates_csv);

  void add(const search::EpisodeRecord& episode, std::uint64_t steps);
  void add(const ppo::UpdateReport& update, std::uint64_t steps);

  /// Figures of the last kRecentEpisodes, or of as many as there are. Without any they mean nothing, and the updates' cells for them are
  /// empty.
  struct Recent {
    std::size_t episodes = 0;
    double median_reward = 0.0;
    double found_fraction = 0.0;
  };
  [[nodiscard]] Recent recent() const;
  /// Median of the medians, mean of the shares found, over the trainings in which an episode has ended.
  [[nodiscard]] static Recent recent_of_all(std::span<const Recent> trainings);
  [[nodiscard]] std::uint64_t episodes() const { return episodes_; }
  [[nodiscard]] const std::string& episodes_csv() const { return episodes_csv_; }
  [[nodiscard]] const std::string& updates_csv() const { return updates_csv_; }

 private:
  struct Outcome {
    double reward;
    bool found;
  };
  void remember(Outcome outcome);

  std::string episodes_csv_;
  std::string updates_csv_;
  std::deque<Outcome> recent_;
  std::uint64_t episodes_ = 0;
};

/// "median reward -2.5, found 98 %", with "-" for both before the first episode has ended
[[nodiscard]] std::string to_string(const LearningCurve::Recent& recent);

/// One row of the episodes' file.
struct EpisodeRow {
  std::uint64_t episode = 0;
  std::uint64_t steps = 0;
  double reward = 0.0;
  bool found = false;
};

/// Takes the next row off the front of `csv`, which begins after the header; false at its end. Throws std::invalid_argument for anything
/// else.
bool take_row(std::string_view& csv, EpisodeRow& row);

inline constexpr std::string_view kEpisodesHeader = "episode,steps,reward,found\n";

}  // namespace earshot::training
