#pragma once

#include <cstddef>
#include <vector>

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

/// Corners of parallel tracks over an area, to be flown in turn: `spacing` apart or less, the outer ones half of it from the sides, from
/// the corner nearest to `start`.
enum class Tracks : bool { kNorthSouth, kEastWest };
[[nodiscard]] std::vector<NorthEast> lawn_mower_corners(const Rectangle& area, Meters spacing, Tracks tracks, NorthEast start);

/// Parallel tracks over the domain inside the border, twice the assured detection range apart (at least two step lengths), north and south;
/// then the same east and west; and so on.
class LawnMower : public Searcher {
 public:
  explicit LawnMower(const PriorKnowledge& prior);
  void begin(Pcg32 random) override;
  [[nodiscard]] std::size_t choose(const DecisionInput& input) override;

 private:
  const PriorKnowledge& prior_;
  Meters spacing_;
  std::vector<NorthEast> corners_;
  std::size_t next_ = 0;
  Tracks tracks_ = Tracks::kNorthSouth;
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
