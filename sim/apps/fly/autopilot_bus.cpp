#include "sim/apps/fly/autopilot_bus.hpp"

#include <poll.h>

#include <stdexcept>

#include "firmware/boards/linux/clock/clock.hpp"
#include "firmware/host/mission/port_settings.hpp"
#include "firmware/host/transport/can_socket.hpp"
#include "firmware/host/transport/lcm_endpoint.hpp"
#include "firmware/wire/lcm/channels.hpp"
#include "firmware/wire/lcm/encoding.hpp"
#include "firmware/wire/n2k/setpoint.hpp"
#include "firmware/wire/n2k/vehicle_state/navigation.hpp"

namespace earshot::fly {
namespace {

messages::Navigation navigation_of(Time now, const vehicle::State& state) {
  return {.time = now, .position = state.position, .depth = state.depth, .heading = state.heading, .speed = state.speed};
}

vehicle::Command command_of(const messages::Setpoint& setpoint) {
  return {.heading = setpoint.heading, .speed = setpoint.speed, .depth = setpoint.depth};
}

class LcmAutopilot final : public AutopilotPort {
 public:
  explicit LcmAutopilot(const host::PortSettings& port) : endpoint_(host::parse_lcm_url(port.address), {wire::kSetpointChannel}) {}

  void publish(Time now, const vehicle::State& state) override {
    if (endpoint_.publish(wire::kNavStateChannel, wire::Encoded(navigation_of(now, state)).bytes()) != Status::kOk)
      throw std::runtime_error("navigation cannot be put on the LCM bus");
  }

  std::uint64_t collect(vehicle::Command& command) override {
    std::uint64_t taken = 0;
    endpoint_.collect();
    for (wire::Lc02Message message; endpoint_.take(message) == Status::kOk;) {
      messages::Setpoint setpoint;
      if (wire::decode(message.data, setpoint) != Status::kOk) continue;
      ++taken;
      command = command_of(setpoint);
    }
    return taken;
  }

  [[nodiscard]] int file_descriptor() const override { return endpoint_.file_descriptor(); }

 private:
  host::LcmEndpoint endpoint_;
};

class CanAutopilot final : public AutopilotPort {
 public:
  CanAutopilot(const host::PortSettings& port, const n2k::LocalPlane& plane) : socket_(port.address), plane_(plane) {}

  void publish(Time now, const vehicle::State& state) override {
    n2k::NavigationFrames frames;
    if (n2k::compose_navigation(navigation_of(now, state), plane_, n2k::kVehicleAddress, frames) != Status::kOk)
      throw std::runtime_error("navigation does not fit its NMEA 2000 messages");
    for (const n2k::Frame& frame : frames) {
      if (socket_.send(frame) != Status::kOk) throw std::runtime_error("navigation cannot be put on the CAN bus");
    }
  }

  std::uint64_t collect(vehicle::Command& command) override {
    std::uint64_t taken = 0;
    for (n2k::Frame frame; socket_.receive(frame) == Status::kOk;) {
      messages::Setpoint setpoint;
      if (receiver_.accept(frame, setpoint) != Status::kOk) continue;
      ++taken;
      command = command_of(setpoint);
    }
    return taken;
  }

  [[nodiscard]] int file_descriptor() const override { return socket_.file_descriptor(); }

 private:
  host::CanSocket socket_;
  n2k::LocalPlane plane_;
  n2k::SetpointReceiver receiver_;
};

std::unique_ptr<AutopilotPort> open_port(const host::PortSettings& port, const n2k::LocalPlane& plane) {
  if (port.kind == host::PortKind::kCan) return std::make_unique<CanAutopilot>(port, plane);
  return std::make_unique<LcmAutopilot>(port);
}

}  // namespace

AutopilotBus::AutopilotBus(const host::MissionFile& mission) {
  for (const host::PortSettings& port : mission.ports) {
    if (port.roles.has(host::Role::kNavigation)) sensors_.push_back(open_port(port, mission.plane));
    if (port.roles.has(host::Role::kAutopilot)) autopilots_.push_back(open_port(port, mission.plane));
  }
}

void AutopilotBus::publish(Time now, const vehicle::State& state) {
  for (const auto& sensor : sensors_) {
    sensor->publish(now, state);
    ++navigation_messages_;
  }
}

void AutopilotBus::collect(vehicle::Command& command) {
  for (const auto& autopilot : autopilots_) setpoint_messages_ += autopilot->collect(command);
}

void AutopilotBus::wait(Duration most) const {
  std::vector<pollfd> readable;
  for (const auto& autopilot : autopilots_) readable.push_back({.fd = autopilot->file_descriptor(), .events = POLLIN, .revents = 0});
  board::wait_for_ports(readable, most);
}

}  // namespace earshot::fly
