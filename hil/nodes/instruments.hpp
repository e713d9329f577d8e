#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "firmware/core/units.hpp"
#include "firmware/wire/n2k/local_plane.hpp"
#include "firmware/wire/n2k/own/conditions.hpp"
#include "hil/nodes/sensor.hpp"
#include "sim/vehicle/vehicle.hpp"

namespace earshot::hil {

// The instruments that a vehicle navigates by, and its battery. Each says where `vehicle` is at that moment, exactly but for what its
// messages round; the vehicle's state must outlive it. Periods are the standard's own (canboat's definitions 8.0.0-beta3, Apache-2.0).
// Oracle: Instruments tests; EmulatedVehicle.IsReadWhereItIs

/// What a compass's heading counts from.
struct MagneticField {
  Radians variation;  ///< of magnetic from true north, east positive
};

/// Heading (127250) and rate of turn (127251) every 100 ms.
/// @param field  none: a gyrocompass, which shows true north. Otherwise a magnetic one, which says the variation (127258) once a second.
[[nodiscard]] std::unique_ptr<Sensor> make_compass(const vehicle::State& vehicle, std::optional<MagneticField> field,
                                                   std::uint32_t unique_number);

/// Speed through the water (128259) once a second.
[[nodiscard]] std::unique_ptr<Sensor> make_speed_log(const vehicle::State& vehicle, std::uint32_t unique_number);

/// Pressure of the water over the air's at the surface (130314) every two seconds.
[[nodiscard]] std::unique_ptr<Sensor> make_depth_sensor(const vehicle::State& vehicle, std::uint32_t unique_number);

/// Height over a sea floor of one depth (128267) once a second; none in reach (not available) above `reach`.
struct SeaFloor {
  Meters depth;
  Meters reach{200.0};
};
[[nodiscard]] std::unique_ptr<Sensor> make_altimeter(const vehicle::State& vehicle, SeaFloor floor, std::uint32_t unique_number);

/// Charge that is left (127506) every 1.5 s, to a percent.
/// @param percent  0 to 100; must outlive it
[[nodiscard]] std::unique_ptr<Sensor> make_battery(const double& percent, std::uint32_t unique_number);

/// Whether there is water in the hull, and a ground fault (65293), once a second.
/// @param hull  must outlive it
[[nodiscard]] std::unique_ptr<Sensor> make_hull_monitor(const n2k::Hull& hull, std::uint32_t unique_number);

/// Inertial navigation: position every 100 ms (129025), course and speed over ground every 250 ms (129026), and once a second the whole
/// fix with its date (129029), whose method is "estimated", as under water it must be.
[[nodiscard]] std::unique_ptr<Sensor> make_navigation(const vehicle::State& vehicle, const n2k::LocalPlane& plane,
                                                      std::uint32_t unique_number);

}  // namespace earshot::hil
