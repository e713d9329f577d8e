#pragma once

#include <cstdint>
#include <optional>

#include "firmware/core/time.hpp"
#include "firmware/core/units.hpp"
#include "firmware/wire/n2k/local_plane.hpp"

namespace earshot::n2k {

/// A value and when it arrived: how old it is stays with it.
template <class T>
struct Reading {
  T value;
  Time time;
};

/// Whether there is one that arrived no longer than `age` before `now`.
template <class T>
[[nodiscard]] constexpr bool is_fresh(const std::optional<Reading<T>>& reading, Time now, Duration age) {
  return reading.has_value() && lies_within(reading->time, now, age);
}

struct Attitude {
  Radians pitch;  ///< bow up
  Radians roll;   ///< starboard down
};

/// Whose corrections a GNSS position uses.
struct ReferenceStation {
  std::optional<std::uint8_t> type;  ///< of table::kGnssType
  std::optional<std::uint16_t> id;
  std::optional<double> age_s;  ///< of the corrections
};

struct OverGround {
  Radians course;  ///< true
  MetersPerSecond speed;
};

struct Battery {
  std::optional<double> voltage_v;
  std::optional<double> current_a;  ///< out of the battery negative
  std::optional<double> temperature_k;
};

/// What the devices on the bus have said last. Empty: never, or the device says that it has no value.
struct Readings {
  std::optional<Reading<Geographic>> position;
  std::optional<Reading<Radians>> heading;  ///< true, clockwise from north, in (-pi, pi]
  std::optional<Reading<Radians>> variation;
  std::optional<Reading<RadiansPerSecond>> rate_of_turn;  ///< clockwise
  std::optional<Reading<Attitude>> attitude;
  std::optional<Reading<MetersPerSecond>> speed;  ///< through the water
  std::optional<Reading<OverGround>> over_ground;
  std::optional<Reading<double>> pressure_pa;  ///< of the water, as the sensor says it
  std::optional<Reading<Meters>> depth;        ///< from the pressure
  std::optional<Reading<Meters>> altitude;     ///< of the transducer over the seabed
  std::optional<Reading<double>> water_temperature_k;
  std::optional<Reading<Battery>> battery;
  std::optional<Reading<double>> charge_percent;  ///< that is left in the battery
  std::optional<Reading<Radians>> rudder;
};

}  // namespace earshot::n2k
