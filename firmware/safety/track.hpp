#pragma once

#include <optional>

#include "firmware/core/geometry.hpp"
#include "firmware/core/time.hpp"
#include "firmware/core/units.hpp"
#include "firmware/messages/navigation.hpp"

namespace earshot::safety {

/// How the vehicle has moved over ground since its search began, from the fixes that were believed.
class Track {
 public:
  void begin(const messages::Navigation& fix);
  /// In the order of their dates.
  void take(const messages::Navigation& fix);
  /// Likewise, one that puts a dead reckoning right: where the vehicle is, but no way that it has gone. How it moves is known from before
  /// until there are fixes kBase apart again.
  void correct(const messages::Navigation& fix);
  /// A new way-point to go to.
  void set_waypoint(NorthEast waypoint);
  /// It goes nowhere for now.
  void forget_waypoint() { waypoint_.reset(); }

  [[nodiscard]] Meters distance() const { return distance_; }
  /// Over ground, per second, over the last two to four seconds; none before that.
  [[nodiscard]] std::optional<NorthEast> velocity_per_s() const { return velocity_; }
  /// Of the heading, likewise, without its sign. From one fix to the next it is taken to turn the shorter way: what turns further than a
  /// half circle between two fixes looks slower than it is.
  [[nodiscard]] RadiansPerSecond turn_rate() const { return turn_rate_; }
  /// Of the depth, likewise; positive: it goes down.
  [[nodiscard]] MetersPerSecond sink_rate() const { return sink_rate_; }
  /// Since the vehicle last came a tenth of kStride nearer to its way-point than ever; nothing without a way-point.
  [[nodiscard]] Duration without_progress(Time now) const;

  /// Rates are taken over at least so long, so that the noise of single fixes is no movement.
  static constexpr Duration kBase = Duration::seconds(2);
  /// Way is counted in pieces of this length, for the same reason.
  static constexpr Meters kStride{50.0};

 private:
  messages::Navigation older_;  ///< at least kBase before the newest
  messages::Navigation old_;    ///< will be the next older_
  Radians turned_since_older_;  ///< to the right, round and round
  Radians turned_since_old_;
  std::optional<NorthEast> velocity_;
  RadiansPerSecond turn_rate_;
  MetersPerSecond sink_rate_;
  NorthEast counted_;  ///< way up to here is in distance_
  Meters distance_;
  std::optional<NorthEast> waypoint_;
  std::optional<Meters> nearest_;  ///< to it so far
  Time came_nearer_;
  messages::Navigation newest_;
};

}  // namespace earshot::safety
