#pragma once

#include <optional>

#include "firmware/config/safety.hpp"
#include "firmware/core/geometry.hpp"
#include "firmware/core/time.hpp"
#include "firmware/core/units.hpp"
#include "firmware/messages/navigation.hpp"
#include "firmware/messages/setpoint.hpp"

namespace earshot::safety {

/// How far a place has gone beside what explains its way, and whether that can be the current.
///
///   unexplained = |d - d0| - (current (t - t0) + uncertain + kNoise),   d = place - sum of the ways that are explained
///
/// over one to two minutes, for what is fast, and ten to twenty, for what is slow.
class DriftWatch {
 public:
  void begin(const messages::Navigation& fix);
  /// @param explained, uncertain  of the way since the last fix
  void take(const messages::Navigation& fix, NorthEast explained, Meters uncertain);
  /// One that puts a dead reckoning right: what it jumps by is no way, and what came before counts on.
  void correct(const messages::Navigation& fix) { take(fix, fix.position - position_, {}); }
  [[nodiscard]] Meters unexplained(MetersPerSecond current) const;

  static constexpr Meters kNoise{50.0};  ///< of two fixes

 private:
  struct Anchor {
    Time time;
    NorthEast drift;
    Meters uncertain;
  };
  struct Window {
    Anchor older;
    Anchor old;
  };
  void move_on(Window& window, Duration length) const;
  [[nodiscard]] Meters unexplained_since(const Anchor& anchor, MetersPerSecond current) const;

  Anchor newest_;
  NorthEast position_;  ///< of the newest fix
  Window minute_;
  Window ten_minutes_;
};

/// Whether fixes fit themselves and what the vehicle is told: what the place moves by, less speed times heading, is the current's way, and
/// no current is stronger than the vehicle's owner says. Of what the fixes say and of what was ordered the way through the water may be
/// wrong by a share; of an order besides by what the vehicle needs to turn and to come to its speed. What moves the place by less than
/// the current and that share cannot be told from the current.
class PlaceEstimate {
 public:
  /// Of a fix that goes on from none, or of a vehicle that is not told to move, or was told nothing, and may be carried.
  void begin(const messages::Navigation& fix);
  /// One that is believed, in the order of their dates, of a vehicle that is told to move.
  void take(const messages::Navigation& fix, const messages::Setpoint& setpoint, const config::VehicleLimits& vehicle);

  /// Likewise, one that puts a dead reckoning right.
  void correct(const messages::Navigation& fix);

  [[nodiscard]] Meters unexplained(const config::VehicleLimits& vehicle) const;

  /// Of heading and speed together: six degrees, and a tenth of the speed, or of what it makes of the speed that it is told.
  static constexpr double kShare = 0.2;
  /// Where the speed is not known, or fixes are further apart than this, the vehicle may have gone anywhere.
  static constexpr Duration kFarApart = Duration::seconds(3);
  /// While nobody hears of it for longer, its own computers may have been away: it may have stopped, and needs to come to its speed again.
  static constexpr Duration kUnheard = Duration::seconds(5);
  /// That is granted once in so long: whose fixes always come as rarely is held to its orders.
  static constexpr Duration kBetweenStops = Duration::seconds(600);
  /// Until it has the speed that it is told.
  static constexpr Duration kGathersWay = Duration::seconds(10);
  /// Where nobody says how strong it may be: tides in straits.
  static constexpr MetersPerSecond kAnyCurrent{4.0};

 private:
  [[nodiscard]] Meters missed_way(const messages::Setpoint& setpoint, double seconds, const config::VehicleLimits& vehicle);

  DriftWatch by_log_;
  DriftWatch by_order_;
  Time time_;                       ///< of the newest fix
  NorthEast each_second_;           ///< through the water, as it says
  std::optional<Radians> ordered_;  ///< heading
  MetersPerSecond ordered_speed_;
  std::optional<Time> stopped_;  ///< when it may have done so last
  double turning_s_ = 0.0;       ///< until it points where it is told, and is as fast
};

}  // namespace earshot::safety
