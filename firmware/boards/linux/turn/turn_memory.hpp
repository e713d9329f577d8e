#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "firmware/config/capacities.hpp"
#include "firmware/core/time.hpp"
#include "firmware/core/units.hpp"
#include "firmware/messages/health.hpp"
#include "firmware/messages/input.hpp"
#include "firmware/messages/port_report.hpp"
#include "firmware/runtime/runtime.hpp"

namespace earshot::board {

/// What the loop's turns remember beside the runtime. All of it follows from what the journal holds: a mission that goes on from its
/// journal remembers the same.
struct TurnMemory {
  Time last;                           ///< the time of the last turn or input
  std::uint64_t inputs = 0;            ///< taken so far
  std::uint64_t navigation_taken = 0;  ///< of these, fixes, but for those without a date that the clock knows
  std::uint64_t snr_taken = 0;         ///< measurements
  bool is_urgent = false;              ///< an ABORT or a leak has come since the last turn
  std::uint64_t unsent_setpoints = 0;  ///< that no port could send
  std::optional<messages::MissionState> recorded_state;
  MetersPerSecond speed;            ///< through the water, by the last fix that could be one; NaN: it does not know
  MetersPerSecond commanded_speed;  ///< of the last set-point; stands in for a speed that nobody knows
  std::array<messages::PortReport, config::kMaxPorts> reports = {};  ///< the newest of each port; kOwnPort's is the journal's

  void note(const messages::Input& input);
  void note(Time turn, const runtime::Outputs& outputs);
};

}  // namespace earshot::board
