#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "firmware/config/capacities.hpp"
#include "firmware/core/geometry.hpp"
#include "firmware/core/time.hpp"
#include "firmware/core/units.hpp"
#include "firmware/messages/bearing_measurement.hpp"
#include "firmware/messages/belief_summary.hpp"
#include "firmware/messages/found_declaration.hpp"

namespace earshot::messages {

/// Why the vehicle goes where it goes: one record per action.
struct Decision {
  std::uint32_t step = 0;  ///< 0 for the first action
  Time time;
  NorthEast position;
  Decibels snr;
  bool too_faint = false;  ///< not measured: the signal lies somewhere below `snr`
  bool detected = false;
  std::uint8_t action = 0;
  bool sweeping = false;    ///< what was heard fits nothing that is believed possible: the action is the sweep's, not the policy's
  bool overridden = false;  ///< the safety layer changed the way-point
  NorthEast waypoint;
  std::uint8_t observation_size = 0;
  std::uint8_t action_count = 0;
  std::array<float, config::kMaxObservation> observation{};
  std::array<float, config::kMaxActions> logits{};
  std::optional<Bearing> bearing = std::nullopt;         ///< that was heard with the SNR; absent when none was measured
  std::optional<BeliefSummary> belief;                   ///< in the mission's frame; absent when the policy holds none
  std::optional<FoundDeclaration> found = std::nullopt;  ///< the vehicle declared the source found here; its place in the mission's frame
};

/// The first so many of a decision's floats. A size that came from outside may be any: more than there is room for is cut, and what others
/// read as below zero is none.
[[nodiscard]] constexpr std::span<const float> counted(std::span<const float> floats, std::uint8_t count) {
  return floats.first(static_cast<std::int8_t>(count) < 0 ? 0 : std::min<std::size_t>(count, floats.size()));
}

}  // namespace earshot::messages
