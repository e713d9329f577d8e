#pragma once

#include <cstdint>
#include <memory>

#include "firmware/boards/linux/mission_file.hpp"
#include "firmware/core/time.hpp"
#include "sim/vehicle/vehicle.hpp"

namespace earshot::simulation {

/// The other side of the vehicle's bus: the sensors that say where the vehicle is, and the autopilot that takes set-points.
class AutopilotBus {
 public:
  AutopilotBus() = default;
  virtual ~AutopilotBus() = default;
  AutopilotBus(const AutopilotBus&) = delete;
  AutopilotBus& operator=(const AutopilotBus&) = delete;

  /// Throws std::runtime_error when the bus cannot carry it.
  virtual void publish(Time now, const vehicle::State& state) = 0;
  /// Takes what has arrived; `command` becomes the newest set-point.
  virtual void collect(vehicle::Command& command) = 0;
  /// For poll().
  [[nodiscard]] virtual int file_descriptor() const = 0;

  [[nodiscard]] std::uint64_t navigation_messages() const { return navigation_messages_; }
  [[nodiscard]] std::uint64_t setpoint_messages() const { return setpoint_messages_; }

 protected:
  std::uint64_t navigation_messages_ = 0;
  std::uint64_t setpoint_messages_ = 0;
};

/// The bus that the mission asks for. @throws std::system_error naming what cannot be opened.
[[nodiscard]] std::unique_ptr<AutopilotBus> open_autopilot_bus(const board::MissionFile& mission);

}  // namespace earshot::simulation
