// libearshot-simulation.so: what earshotd loads to fly in lock-step with a simulator.

#include <cstdio>
#include <exception>
#include <memory>
#include <utility>

#include "firmware/boards/linux/simulation_plugin.hpp"
#include "sim/link/lock_step_clock.hpp"

extern "C" [[gnu::visibility("default")]] earshot::board::Simulation* earshot_open_simulation(
    const earshot::board::SimulationOptions& options, char* error, std::size_t error_size) try {
  auto clock = std::make_unique<earshot::link::LockStepClock>(options.domain, options.run);
  auto link_port = std::make_unique<earshot::link::LockStepPort>(options.port, *clock);
  return new earshot::board::Simulation{.clock = std::move(clock), .port = std::move(link_port)};
} catch (const std::exception& e) {
  (void)std::snprintf(error, error_size, "%s", e.what());
  return nullptr;
}
