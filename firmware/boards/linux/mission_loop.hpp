#pragma once

#include <csignal>
#include <cstdint>

#include "firmware/boards/linux/mission_turn.hpp"
#include "firmware/boards/linux/vehicle_bus.hpp"
#include "firmware/core/time.hpp"
#include "sim/link/runtime_end.hpp"

namespace earshot::board {

/// Why a loop returned.
enum class LoopEnd : std::uint8_t {
  kMissionOver,    ///< DONE or ABORT, and the simulator knows
  kStopped,        ///< a person asked for it (SIGINT, SIGTERM)
  kSimulatorLost,  ///< it left or died in mid-mission
  kBusLost,        ///< the simulator announced navigation that did not arrive over the bus
};

struct LoopResult {
  LoopEnd end = LoopEnd::kStopped;
  runtime::Outputs last;
  Time time;
};

/// In lock-step with a simulator: one turn for every tick, once the navigation that the tick announces has arrived over the bus.
/// The simulator is waited for without limit before its first tick.
/// @param stop  set by a signal handler
[[nodiscard]] LoopResult fly_in_simulation(MissionTurn& turn, VehicleBus& bus, link::RuntimeEnd& link,
                                           const volatile std::sig_atomic_t& stop);

/// On the host's clock: one turn every `period` with whatever has arrived. After DONE or ABORT it goes on telling the autopilot to come up.
/// Ends when told to stop.
[[nodiscard]] LoopResult fly_at_sea(MissionTurn& turn, VehicleBus& bus, Duration period, const volatile std::sig_atomic_t& stop);

}  // namespace earshot::board
