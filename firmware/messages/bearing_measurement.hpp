#pragma once

#include <cstdint>
#include <optional>

#include "firmware/core/time.hpp"
#include "firmware/core/units.hpp"
#include "firmware/messages/ranges.hpp"

namespace earshot::messages {

/// From where a sound comes. What cannot tell left from right (a line of hydrophones) hears the same from either side of its axis:
/// `mirror_axis` is then that axis, and 2 mirror_axis - direction is as likely as `direction`.
struct Bearing {
  Radians direction;                                  ///< of the source from the vehicle, true, clockwise from north, 0 to 2 pi
  Radians deviation;                                  ///< standard deviation of `direction`, > 0 and at most pi
  std::optional<Radians> mirror_axis = std::nullopt;  ///< true, clockwise from north, 0 to 2 pi; absent: `direction` is the only one
  friend constexpr bool operator==(const Bearing&, const Bearing&) = default;
};

/// False for a NaN.
[[nodiscard]] constexpr bool is_of_a_compass(Radians angle) {
  return kDirection_rad.contains(angle.value);
}

/// Whether every angle is in its range; false for a NaN in any of them.
[[nodiscard]] constexpr bool is_possible(const Bearing& bearing) {
  return is_of_a_compass(bearing.direction) && kDeviation_rad.contains(bearing.deviation.value) &&
         (!bearing.mirror_axis || is_of_a_compass(*bearing.mirror_axis));
}

/// A bearing of the source, from an array of hydrophones at sea, from the simulator in simulation. It comes beside an SNR, and never
/// in place of one.
struct BearingMeasurement {
  Time time;  ///< end of the interval that it was measured over
  Bearing bearing;
  std::uint32_t sender = 0;  ///< who measured it: a number of its own, where several arrays are heard by one port
  friend constexpr bool operator==(const BearingMeasurement&, const BearingMeasurement&) = default;
};

}  // namespace earshot::messages
