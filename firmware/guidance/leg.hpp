#pragma once

#include "firmware/core/geometry.hpp"
#include "firmware/core/units.hpp"

namespace earshot::guidance {

/// The straight line that one action of the policy makes the vehicle follow.
class Leg {
 public:
  Leg() = default;
  /// A leg between two different points; between equal points it has no length, points north and is over at once.
  Leg(NorthEast start, NorthEast waypoint);

  [[nodiscard]] NorthEast waypoint() const { return waypoint_; }
  [[nodiscard]] Meters length() const { return length_; }

  /// Distance made good along the leg: negative behind its start.
  [[nodiscard]] Meters along_track(NorthEast position) const;
  /// Distance beside the leg: positive to the right of it, looking along it.
  [[nodiscard]] Meters cross_track(NorthEast position) const;

  /// The leg is over when the vehicle crosses the line through the way-point square to the leg, however far beside the way-point.
  [[nodiscard]] bool is_over(NorthEast position) const { return along_track(position) >= length_; }

  /// Line-of-sight guidance: steer at the point of the leg one look-ahead distance further on.
  ///
  ///   heading = bearing + atan(-e / D),   e: cross-track distance, D: look-ahead distance
  ///
  /// @return heading in (-pi, pi].
  /// Source: Fossen, Handbook of Marine Craft Hydrodynamics and Motion Control (2011), Eq. 10.71 (look-ahead-based steering, no integral
  /// term). Oracle: Leg.SteersFortyFiveDegreesTowardsTheTrackWhenOneLookAheadBesideIt
  [[nodiscard]] Radians heading_to_steer(NorthEast position) const;

  /// D: the vehicle comes back to the track over a few of these; 50 s at 2 m/s, well over an autopilot's turning time.
  static constexpr Meters kLookahead{100.0};

 private:
  NorthEast start_;
  NorthEast waypoint_;
  UnitNorthEast direction_;
  Radians bearing_;
  Meters length_;
};

}  // namespace earshot::guidance
