#pragma once

#include <optional>

#include "firmware/core/time.hpp"
#include "firmware/core/units.hpp"
#include "hil/nodes/vehicle/disturbance.hpp"
#include "sim/vehicle/battery.hpp"
#include "sim/vehicle/vehicle.hpp"

namespace earshot::hil {

using vehicle::Battery;

/// A vehicle in the water and what is wrong with it, whatever bus its devices are on: where it is, and what its instruments measure of
/// that.
class MovingVehicle {
 public:
  MovingVehicle(const vehicle::State& start, const vehicle::Limits& limits, Battery battery);

  /// From the next move() on.
  void disturb(const Disturbance& disturbance);
  /// As its autopilot wants, or as its disturbance lets it. Time never goes back.
  void move(Time now, const vehicle::Command& wanted);

  // All of these may be kept by reference.
  [[nodiscard]] const vehicle::State& state() const { return state_; }
  [[nodiscard]] const vehicle::State& reported() const { return reported_; }      ///< by compass, log, depth sensor and navigation
  [[nodiscard]] const vehicle::State& over_floor() const { return over_floor_; }  ///< by the altimeter
  [[nodiscard]] const Disturbance& disturbance() const { return disturbance_; }
  [[nodiscard]] const double& battery_percent() const { return battery_.percent; }

  [[nodiscard]] Meters sailed() const { return sailed_; }

 private:
  [[nodiscard]] vehicle::Command possible(vehicle::Command wanted) const;
  void update_reported();

  vehicle::State state_;
  vehicle::State reported_;
  vehicle::State over_floor_;
  NorthEast place_;  ///< that its navigation goes by
  vehicle::Limits limits_;
  Battery battery_;
  Disturbance disturbance_;
  RadiansPerSecond turning_;  ///< as it turned last
  std::optional<Time> last_;
  Meters sailed_;
};

}  // namespace earshot::hil
