#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "firmware/core/time.hpp"
#include "firmware/host/mission/mission_file.hpp"
#include "sim/vehicle/vehicle.hpp"

namespace earshot::fly {

/// The other side of one of the vehicle's ports: the sensors that say where the vehicle is, the autopilot that takes set-points, or both.
class AutopilotPort {
 public:
  AutopilotPort() = default;
  virtual ~AutopilotPort() = default;
  AutopilotPort(const AutopilotPort&) = delete;
  AutopilotPort& operator=(const AutopilotPort&) = delete;

  /// Throws std::runtime_error when the bus cannot carry it.
  virtual void publish(Time now, const vehicle::State& state) = 0;
  /// Takes what has arrived; `command` becomes the newest set-point.
  /// @return set-points taken
  virtual std::uint64_t collect(vehicle::Command& command) = 0;
  /// For poll().
  [[nodiscard]] virtual int file_descriptor() const = 0;
};

/// The other side of all ports of a mission: navigation goes to every port that brings it, set-points come from every port that takes them.
class AutopilotBus {
 public:
  /// @throws std::system_error naming what cannot be opened.
  explicit AutopilotBus(const host::MissionFile& mission);

  /// Throws std::runtime_error when a bus cannot carry it.
  void publish(Time now, const vehicle::State& state);
  /// Takes what has arrived; `command` becomes the newest set-point.
  void collect(vehicle::Command& command);
  /// Until collect() has something to take, but no longer than `most`.
  void wait(Duration most) const;

  [[nodiscard]] std::uint64_t navigation_messages() const { return navigation_messages_; }
  [[nodiscard]] std::uint64_t setpoint_messages() const { return setpoint_messages_; }

 private:
  std::vector<std::unique_ptr<AutopilotPort>> sensors_;     ///< ports with the role navigation
  std::vector<std::unique_ptr<AutopilotPort>> autopilots_;  ///< ports with the role autopilot
  std::uint64_t navigation_messages_ = 0;
  std::uint64_t setpoint_messages_ = 0;
};

}  // namespace earshot::fly
