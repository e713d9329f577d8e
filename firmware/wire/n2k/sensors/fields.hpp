#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "firmware/core/fixed_vector.hpp"
#include "firmware/core/status.hpp"
#include "firmware/core/units.hpp"
#include "firmware/wire/n2k/local_plane.hpp"
#include "firmware/wire/n2k/sensors/readings.hpp"
#include "firmware/wire/n2k/table/messages.hpp"

/// What the bytes of a sensor's message mean, without a past. All fail as decode() does; kUnsupported: in a reference that is not taken.
namespace earshot::n2k::fields {

using Bytes = std::span<const std::uint8_t>;

struct Heading {
  Radians value;  ///< corrected by the compass's deviation, where the message has it
  bool is_true = false;
  std::optional<Radians> variation;  ///< in the message itself
};

/// A value of water, or of something else: only the former is of interest.
struct Sourced {
  double value = 0.0;
  bool is_water = false;
};

[[nodiscard]] Result<Geographic> position(Bytes bytes);
/// kNotReady also when the numbers are not measured: "no GNSS", typed in by hand, or simulated.
[[nodiscard]] Result<Geographic> gnss_position(Bytes bytes);
/// As many as the longest message holds: 45.
inline constexpr std::size_t kMostReferenceStations = (kMaxMessageSize - table::kGnss.size) / table::kReferenceStationBytes;
using ReferenceStations = FixedVector<ReferenceStation, kMostReferenceStations>;
/// Of 129029. kMalformed also when it ends before the last that it counts.
[[nodiscard]] Result<ReferenceStations> reference_stations(Bytes bytes);
[[nodiscard]] Result<Heading> heading(Bytes bytes);
[[nodiscard]] Result<Radians> variation(Bytes bytes);
[[nodiscard]] Result<RadiansPerSecond> rate_of_turn(Bytes bytes);
[[nodiscard]] Result<Attitude> attitude(Bytes bytes);
[[nodiscard]] Result<MetersPerSecond> speed(Bytes bytes);
/// kUnsupported: the course is magnetic.
[[nodiscard]] Result<OverGround> over_ground(Bytes bytes);
[[nodiscard]] Result<Meters> altitude(Bytes bytes);
[[nodiscard]] Result<Radians> rudder(Bytes bytes);
[[nodiscard]] Result<Sourced> pressure(Bytes bytes);     ///< Pa
[[nodiscard]] Result<Sourced> temperature(Bytes bytes);  ///< K
/// kNotReady: neither voltage, current nor temperature is there.
[[nodiscard]] Result<Battery> battery(Bytes bytes);

/// Percent that is left in a battery, 0 to 100; nothing of another source of direct current.
[[nodiscard]] Result<std::optional<double>> charge(Bytes bytes);

[[nodiscard]] std::optional<std::uint8_t> rudder_instance(Bytes bytes);
[[nodiscard]] std::optional<std::uint8_t> pressure_instance(Bytes bytes);
[[nodiscard]] std::optional<std::uint8_t> temperature_instance(Bytes bytes);
[[nodiscard]] std::optional<std::uint8_t> battery_instance(Bytes bytes);
[[nodiscard]] std::optional<std::uint8_t> charge_instance(Bytes bytes);

}  // namespace earshot::n2k::fields
