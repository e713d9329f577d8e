#pragma once

#include <atomic>
#include <cstdint>

#include "firmware/boards/linux/host_clock.hpp"
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
  Time began;  ///< at sea: when the loop began; in simulation: the first tick
  Time time;   ///< of the last turn
};

/// In lock-step with a simulator: one turn for every tick, once the navigation that the tick announces has arrived over the bus.
/// The simulator is waited for without limit before its first tick.
/// @param stop  set by a signal handler
[[nodiscard]] LoopResult fly_in_simulation(MissionTurn& turn, VehicleBus& bus, link::RuntimeEnd& link, const std::atomic<bool>& stop);

/// What the loop at sea needs to know of the mission.
struct SeaTiming {
  Duration period;              ///< between two turns
  Duration navigation_timeout;  ///< see SenderClock
  Duration snr_timeout;
};

/// On the host's clock: one turn every period with whatever has arrived. After DONE or ABORT it goes on telling the autopilot to come up.
/// Ends when told to stop, with a last turn: an
/// ABORT if the mission is not over yet, so that the autopilot does not go on with the last set-point of the search.
/// Mission time is UTC as it is when the loop begins, and runs on whatever becomes of the wall clock; messages dated by a wall clock are
/// moved to it (SenderClock).
[[nodiscard]] LoopResult fly_at_sea(MissionTurn& turn, VehicleBus& bus, const HostClock& host, const SeaTiming& timing,
                                    const std::atomic<bool>& stop);

}  // namespace earshot::board
