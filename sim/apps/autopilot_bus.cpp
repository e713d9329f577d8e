#include "sim/apps/autopilot_bus.hpp"

#include <stdexcept>

#include "earshot/nav_state_t.hpp"
#include "earshot/setpoint_t.hpp"
#include "firmware/boards/linux/can_socket.hpp"
#include "firmware/boards/linux/lcm_codec.hpp"
#include "firmware/boards/linux/lcm_endpoint.hpp"
#include "firmware/boards/linux/messages.hpp"
#include "firmware/wire/lcm/channels.hpp"
#include "firmware/wire/n2k/navigation.hpp"
#include "firmware/wire/n2k/setpoint.hpp"

namespace earshot::simulation {
namespace {

runtime::Navigation navigation_of(Time now, const vehicle::State& state) {
  return {.time = now, .position = state.position, .depth = state.depth, .heading = state.heading, .speed = state.speed};
}

class LcmAutopilot final : public AutopilotBus {
 public:
  explicit LcmAutopilot(const board::MissionFile& mission) : endpoint_(board::parse_lcm_url(mission.lcm_url), {wire::kSetpointChannel}) {}

  void publish(Time now, const vehicle::State& state) override {
    if (board::publish(endpoint_, wire::kNavStateChannel, board::to_message(navigation_of(now, state))) != Status::kOk) {
      throw std::runtime_error("navigation cannot be put on the LCM bus");
    }
    ++navigation_messages_;
  }

  void collect(vehicle::Command& command) override {
    endpoint_.collect();
    for (wire::Lc02Message message; endpoint_.take(message) == Status::kOk;) {
      setpoint_t setpoint{};
      if (board::decode(message.data, setpoint) != Status::kOk) continue;
      ++setpoint_messages_;
      command = {.heading = Radians{setpoint.heading_rad}, .speed = MetersPerSecond{setpoint.speed_mps}, .depth = Meters{setpoint.depth_m}};
    }
  }

  [[nodiscard]] int file_descriptor() const override { return endpoint_.file_descriptor(); }

 private:
  board::LcmEndpoint endpoint_;
};

class CanAutopilot final : public AutopilotBus {
 public:
  explicit CanAutopilot(const board::MissionFile& mission) : socket_(mission.can_interface), plane_(mission.plane) {}

  void publish(Time /*now*/, const vehicle::State& state) override {
    const n2k::Navigation fix{.position = state.position, .depth = state.depth, .heading = state.heading, .speed = state.speed};
    n2k::NavigationFrames frames;
    if (n2k::compose_navigation(fix, plane_, n2k::kVehicleAddress, frames) != Status::kOk)
      throw std::runtime_error("navigation does not fit its NMEA 2000 messages");
    for (const n2k::Frame& frame : frames) {
      if (socket_.send(frame) != Status::kOk) throw std::runtime_error("navigation cannot be put on the CAN bus");
    }
    ++navigation_messages_;
  }

  void collect(vehicle::Command& command) override {
    for (n2k::Frame frame; socket_.receive(frame) == Status::kOk;) {
      n2k::Setpoint setpoint;
      if (receiver_.accept(frame, setpoint) != Status::kOk) continue;
      ++setpoint_messages_;
      command = {.heading = setpoint.heading, .speed = setpoint.speed, .depth = setpoint.depth};
    }
  }

  [[nodiscard]] int file_descriptor() const override { return socket_.file_descriptor(); }

 private:
  board::CanSocket socket_;
  n2k::LocalPlane plane_;
  n2k::SetpointReceiver receiver_;
};

}  // namespace

std::unique_ptr<AutopilotBus> open_autopilot_bus(const board::MissionFile& mission) {
  if (mission.bus == board::BusKind::kCan) return std::make_unique<CanAutopilot>(mission);
  return std::make_unique<LcmAutopilot>(mission);
}

}  // namespace earshot::simulation
