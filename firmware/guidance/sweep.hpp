#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "firmware/core/geometry.hpp"
#include "firmware/core/units.hpp"
#include "firmware/guidance/parallel_tracks.hpp"

namespace earshot::guidance {

/// What is swept, and in which steps.
struct SweepPlan {
  Rectangle area;      ///< of which every place is to be come near
  Meters margin;       ///< of its edges that tracks and way-points keep out of, >= 0
  Meters step_length;  ///< l > 0: a way-point is so far from the one before, and what lies within it of one is come near
};

/// One step of a sweep.
struct SweepStep {
  NorthEast waypoint;  ///< on the track, a step length on from beside the vehicle; nearer where the track ends
  std::size_t action;  ///< that ends nearest to it, of those that end out of the margin if any does
};

/// A lawn-mower's path over the whole area, whatever is heard: tracks along the longer side, at most two step lengths apart, the outermost
/// along the margin, from its nearest corner; when that is done, tracks across it; and so on.
///
/// It goes by what navigation says, remembers the corner it makes for and where it came from, and takes its next step from wherever the
/// vehicle then is: whoever flies otherwise for a while goes on where it stopped. Steps are whole and directions few: a corner counts as
/// reached within half a step length, or when no action brings the vehicle nearer.
/// Oracle: Sweep.*
class Sweep {
 public:
  Sweep() = default;
  /// @param position  where it begins, finite
  Sweep(const SweepPlan& plan, NorthEast position);

  /// @param position  of the vehicle, finite
  /// @param actions   the directions of a step, at least one
  [[nodiscard]] SweepStep next(NorthEast position, std::span<const UnitNorthEast> actions);

  /// Corners reached since it began.
  [[nodiscard]] std::uint32_t corners_reached() const { return corners_reached_; }

 private:
  [[nodiscard]] NorthEast corner() const { return tracks_.corner(next_); }
  [[nodiscard]] bool is_reached(NorthEast position, std::span<const UnitNorthEast> actions) const;
  [[nodiscard]] std::size_t action_toward(NorthEast place, NorthEast position, std::span<const UnitNorthEast> actions) const;
  [[nodiscard]] NorthEast waypoint_from(NorthEast position) const;
  void turn(NorthEast position);

  Rectangle inside_;  ///< out of the margin
  Meters step_length_;
  Tracks direction_ = Tracks::kNorthSouth;
  ParallelTracks tracks_;
  NorthEast from_;  ///< where the line to the corner begins
  std::uint16_t next_ = 0;
  std::uint32_t corners_reached_ = 0;
};

}  // namespace earshot::guidance
