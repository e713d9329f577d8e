#pragma once

#include <cstddef>
#include <cstdint>

#include "firmware/core/geometry.hpp"
#include "firmware/core/units.hpp"

namespace earshot::guidance {

/// Which way tracks run.
enum class Tracks : bool { kNorthSouth, kEastWest };

/// Where the outermost of them lie.
enum class OuterTracks : bool {
  kOnTheSides,      ///< of the area: what is looked for may lie beyond
  kHalfASpacingIn,  ///< from the sides: nothing beyond is looked for
};

/// How an area is covered.
struct TrackPlan {
  Rectangle area;  ///< no side negative
  Meters spacing;  ///< of the tracks, > 0: they lie evenly, so far apart or less
  OuterTracks outer = OuterTracks::kOnTheSides;
  Tracks tracks = Tracks::kNorthSouth;
  std::uint16_t passes = 1;  ///< >= 1: the first takes every so many-th track, the others come back to those between
};

/// Parallel tracks over an area, the corners of a lawn-mower's path, flown in turn: there and back, from the corner nearest to a start.
/// Of p passes the first takes tracks 0, p, 2p..., the next, on the way back, those one further on, and so on. With w across and d =
/// spacing there are w / d tracks half a spacing in from the sides, and one more on them, both rounded up. Oracle: ParallelTracks.*
class ParallelTracks {
 public:
  ParallelTracks() = default;
  ParallelTracks(const TrackPlan& plan, NorthEast start);

  /// Two for each track, 2 to 2 * kMostTracks.
  [[nodiscard]] std::size_t corner_count() const { return std::size_t{2} * count_; }
  /// @param index  below corner_count()
  [[nodiscard]] NorthEast corner(std::size_t index) const;

  /// More are not flown; then they lie further apart.
  static constexpr std::uint16_t kMostTracks = 10'000;

 private:
  [[nodiscard]] std::size_t track_in_turn(std::size_t turn) const;

  TrackPlan plan_;
  double first_ = 0.0;  ///< gaps from the side at which coordinates begin to the first track
  Meters apart_;
  std::uint16_t count_ = 1;
  bool starts_at_far_side_ = false;
  bool starts_at_far_end_ = false;
};

}  // namespace earshot::guidance
