#pragma once

#include <cstddef>
#include <optional>

#include "firmware/guidance/parallel_tracks.hpp"
#include "firmware/guidance/sweep.hpp"
#include "policy/baselines/searcher.hpp"

namespace earshot::baselines {

// Searchers that go their way whatever they hear.

/// Every action as likely as any other of those that do not end in the border.
class RandomWalk : public Searcher {
 public:
  explicit RandomWalk(const PriorKnowledge& prior) : prior_(prior) {}
  void begin(Pcg32 random) override { random_ = random; }
  [[nodiscard]] std::size_t choose(const DecisionInput& input) override;

 private:
  const PriorKnowledge& prior_;
  Pcg32 random_{0};
};

/// The range up to which the source is expected to be heard without a gap.
[[nodiscard]] Meters assured_detection_range(const PriorKnowledge& prior);

/// Parallel tracks over the domain inside the border, twice the assured detection range apart (at least two step lengths), north and south;
/// then the same east and west; and so on.
class LawnMower : public Searcher {
 public:
  explicit LawnMower(const PriorKnowledge& prior);
  void begin(Pcg32 random) override;
  [[nodiscard]] std::size_t choose(const DecisionInput& input) override;

 private:
  void plan_from(NorthEast start);

  const PriorKnowledge& prior_;
  Meters spacing_;
  std::optional<guidance::ParallelTracks> path_;  ///< of this search, from its first decision on
  std::size_t next_ = 0;
  guidance::Tracks tracks_ = guidance::Tracks::kNorthSouth;
};

/// What a vehicle flies that no longer trusts what it believes (firmware/guidance/sweep): tracks two step lengths apart over all of the
/// domain, out of the border.
class SweepSearch : public Searcher {
 public:
  explicit SweepSearch(const PriorKnowledge& prior) : prior_(prior) {}
  void begin(Pcg32 random) override;
  [[nodiscard]] std::size_t choose(const DecisionInput& input) override;

 private:
  const PriorKnowledge& prior_;
  std::optional<guidance::Sweep> sweep_;  ///< of this search, from its first decision on
};

/// A square spiral about the start, its tracks two step lengths apart, so that no source between them is missed: legs of 2, 2, 4, 4,
/// 6, 6... step lengths north, east, south, west. A leg that would enter the border is cut short.
class ExpandingSquare : public Searcher {
 public:
  explicit ExpandingSquare(const PriorKnowledge& prior) : prior_(prior) {}
  void begin(Pcg32 random) override;
  [[nodiscard]] std::size_t choose(const DecisionInput& input) override;

 private:
  void turn();

  const PriorKnowledge& prior_;
  std::size_t leg_ = 0;
  std::size_t steps_left_ = 0;
};

}  // namespace earshot::baselines
