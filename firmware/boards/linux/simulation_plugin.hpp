#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>

#include "firmware/boards/linux/clock/clock.hpp"
#include "firmware/boards/linux/port/port.hpp"

namespace earshot::board {

// The one seam between the vehicle's program and a simulator: a shared library that only the simulation brings (sim/link) and that is
// looked for when somebody asks for it on the command line. So the very same program flies and simulates, and what is installed on a
// vehicle needs no simulation middleware.

/// What drives the loop in place of the host's clock, and brings what no bus does.
struct Simulation {
  std::unique_ptr<Clock> clock;
  std::unique_ptr<Port> port;  ///< refers to the clock
};

/// Which simulator.
struct SimulationOptions {
  std::uint32_t domain = 0;  ///< DDS domain in which it is
  std::uint64_t run = 0;     ///< number of the run that it belongs to; 0: the first simulator that knocks
  std::uint8_t port = 0;     ///< index of the port that it brings
};

/// What the shared library exports, under this name. `error` takes the reason when null is returned.
using OpenSimulation = Simulation* (*)(const SimulationOptions& options, char* error, std::size_t error_size);
inline constexpr const char* kOpenSimulationSymbol = "earshot_open_simulation";
inline constexpr const char* kSimulationLibrary = "libearshot-simulation.so";

/// @throws host::BadInput when the library is not beside the program (or in ../lib/earshot from there), or cannot be used.
[[nodiscard]] Simulation open_simulation(const SimulationOptions& options);

}  // namespace earshot::board
