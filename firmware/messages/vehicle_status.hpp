#pragma once

#include <limits>

#include "firmware/core/time.hpp"
#include "firmware/core/units.hpp"
#include "firmware/messages/ranges.hpp"

namespace earshot::messages {

/// How the vehicle is. What it does not measure is NaN, or false.
struct VehicleStatus {
  static constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

  Time time;
  Meters altitude{kUnknown};          ///< above the sea floor; NaN: no bottom in reach
  double battery_percent = kUnknown;  ///< charge that is left; NaN: not known
  bool has_leak = false;              ///< water in the hull
  bool has_ground_fault = false;
  friend constexpr bool operator==(const VehicleStatus&, const VehicleStatus&) = default;
};

/// With "not known" in place of a number that is none: an alarm beside it counts all the same.
[[nodiscard]] constexpr VehicleStatus usable_part_of(VehicleStatus status) {
  if (!kAltitude_m.contains(status.altitude.value)) status.altitude = Meters{VehicleStatus::kUnknown};
  if (!kBattery_percent.contains(status.battery_percent)) status.battery_percent = VehicleStatus::kUnknown;
  return status;
}

}  // namespace earshot::messages
