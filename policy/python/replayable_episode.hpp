#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "firmware/core/geometry.hpp"
#include "firmware/core/random.hpp"
#include "policy/python/search_problem.hpp"
#include "sim/search/episode/episode.hpp"

namespace earshot::python {

/// Where a search was told to begin.
struct Places {
  NorthEast position;
  NorthEast source;
};

/// What it takes to run an episode again up to where it is.
struct EpisodeHistory {
  Pcg32::State random{.state = 0, .increment = 1};  ///< when it began; of one that has not begun, now
  bool is_started = false;
  std::optional<Places> places;  ///< nothing: they were drawn
  std::string actions;           ///< taken since, a byte each
};

/// One episode, its random numbers and its history: that is what can be written down. The episode itself is memory of the vehicle's core,
/// which has no form outside of it. A copy goes on as the original would.
class ReplayableEpisode {
 public:
  void seed(const Pcg32& random) { random_ = random; }
  /// Draws the next search.
  void start(const SearchProblem& problem);
  /// @param places  in the search domain
  void start_at(const SearchProblem& problem, const Places& places);
  /// Takes one step; returns its reward. @param action  one of the world's; the episode is running
  double step(const SearchProblem& problem, std::size_t action);

  [[nodiscard]] const search::Episode& episode() const { return episode_; }
  [[nodiscard]] bool is_started() const { return is_started_; }

  [[nodiscard]] EpisodeHistory history() const;
  /// The episode whose history() this was, in the same search. Throws host::BadInput for what can be no history of one.
  [[nodiscard]] static ReplayableEpisode from(const SearchProblem& problem, const EpisodeHistory& history);

 private:
  void begin(const std::optional<Places>& places);

  search::Episode episode_;
  Pcg32 random_{0};
  Pcg32 before_{0};  ///< its random numbers when the search began
  std::optional<Places> places_;
  std::string actions_;
  bool is_started_ = false;
};

}  // namespace earshot::python
