#pragma once

#include "firmware/config/safety.hpp"
#include "firmware/core/geometry.hpp"
#include "firmware/core/time.hpp"
#include "firmware/core/units.hpp"
#include "firmware/messages/navigation.hpp"

namespace earshot::safety {

/// Whether fixes fit themselves: what the place moves by, less speed times heading, is the current's way, and no current is stronger than
/// the vehicle's owner says.
///
///   unexplained = |d - d0| - (current (t - t0) + kShare way + kNoise),   d = place - sum of speed (cos heading, sin heading) dt
///
/// way: through the water since t0; where the speed is not known, or fixes are further apart than kFarApart, anywhere that the vehicle can
/// have gone counts. Over one to two minutes, for what is fast, and ten to twenty, for what is slow. What moves the place by less than
/// current + kShare speed besides cannot be told from the current.
class PlaceEstimate {
 public:
  /// Of a fix that goes on from none, or of a vehicle that is not told to move and may be carried.
  void begin(const messages::Navigation& fix);
  /// One that is believed, in the order of their dates.
  void take(const messages::Navigation& fix, const config::VehicleLimits& vehicle);

  [[nodiscard]] Meters unexplained(const config::VehicleLimits& vehicle) const;

  /// Of heading and speed together: six degrees, and a tenth of the speed.
  static constexpr double kShare = 0.2;
  static constexpr Meters kNoise{50.0};  ///< of two fixes
  static constexpr Duration kFarApart = Duration::seconds(3);
  /// Where nobody says how strong it may be: tides in straits.
  static constexpr MetersPerSecond kAnyCurrent{4.0};

 private:
  struct Anchor {
    Time time;
    NorthEast drift;
    Meters way;
  };
  struct Window {
    Anchor older;
    Anchor old;
  };
  void move_on(Window& window, Duration length) const;
  [[nodiscard]] Meters unexplained_since(const Anchor& anchor, MetersPerSecond current) const;

  Anchor newest_;
  NorthEast position_;     ///< of the newest fix
  NorthEast each_second_;  ///< through the water, as the newest fix says
  Window minute_;
  Window ten_minutes_;
};

}  // namespace earshot::safety
