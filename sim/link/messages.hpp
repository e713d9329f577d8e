#pragma once

#include <cstdint>
#include <optional>

#include "firmware/core/geometry.hpp"
#include "firmware/core/time.hpp"
#include "firmware/core/units.hpp"
#include "firmware/messages/bearing_measurement.hpp"
#include "firmware/messages/safety_event.hpp"

namespace earshot::link {

// What the link carries, without its transport; sim.idl says what each field means.

struct Tick {
  std::uint64_t number = 0;  ///< 0 knocks, and stays within the link
  Time time;
  std::uint64_t navigation_messages = 0;
  std::uint64_t hydrophone_blocks = 0;
  std::optional<Decibels> snr;
  bool snr_too_faint = false;                               ///< not measured: the signal lies somewhere below `snr`
  std::optional<messages::Bearing> bearing = std::nullopt;  ///< of a vehicle that has an array
  std::uint8_t command = 0;
  std::optional<double> battery_percent = std::nullopt;  ///< charge that is left, of a vehicle that tells it
};

struct Answer {
  std::uint64_t number = 0;
  std::uint64_t turns_made = 0;
  std::uint64_t setpoint_messages = 0;
  std::uint32_t steps_taken = 0;
  std::uint8_t state = 0;
  std::uint8_t end_reason = 0;
  std::optional<NorthEast> believed_source = std::nullopt;   ///< where it was likeliest at the last decision
  float mismatch_bits = 0.0F;                                ///< of the belief after its last measurement; 0 without one
  bool is_sweeping = false;                                  ///< the last decision was the sweep's
  bool is_found = false;                                     ///< with its last measurement the vehicle said that it has found the source
  std::optional<messages::SafetyEvent> rule = std::nullopt;  ///< that ends the mission, or sends the vehicle home or up, from this turn on
};

struct GroundTruth {
  Time time;
  NorthEast vehicle;
  Meters vehicle_depth;
  Radians vehicle_heading;
  NorthEast source;
  Meters range;
};

}  // namespace earshot::link
