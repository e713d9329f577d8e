#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "firmware/core/time.hpp"
#include "firmware/host/mission/mission_file.hpp"
#include "firmware/host/transport/lcm_endpoint.hpp"
#include "firmware/messages/bearing_measurement.hpp"
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

/// Whether a bearing may come by the port: CAN carries none.
[[nodiscard]] bool brings_bearings(const host::PortSettings& port);

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

  /// A bearing, to one port that brings an SNR: were it said to two, the vehicle would hear two arrays.
  /// Throws std::runtime_error when the bus cannot carry it. One port of the mission brings_bearings().
  void publish(const messages::BearingMeasurement& bearing);

  [[nodiscard]] std::uint64_t navigation_messages() const { return navigation_messages_; }
  [[nodiscard]] std::uint64_t bearing_messages() const { return bearing_messages_; }
  [[nodiscard]] std::uint64_t setpoint_messages() const { return setpoint_messages_; }

 private:
  std::vector<std::unique_ptr<AutopilotPort>> sensors_;     ///< ports with the role navigation
  std::vector<std::unique_ptr<AutopilotPort>> autopilots_;  ///< ports with the role autopilot
  std::unique_ptr<host::LcmEndpoint> array_;                ///< the first that brings_bearings(); null where none does
  std::uint64_t navigation_messages_ = 0;
  std::uint64_t bearing_messages_ = 0;
  std::uint64_t setpoint_messages_ = 0;
};

}  // namespace earshot::fly
