#include "firmware/boards/linux/vehicle_bus.hpp"

#include "firmware/boards/linux/can_socket.hpp"
#include "firmware/boards/linux/lcm_codec.hpp"
#include "firmware/boards/linux/lcm_endpoint.hpp"
#include "firmware/boards/linux/messages.hpp"
#include "firmware/wire/lcm/channels.hpp"
#include "firmware/wire/n2k/navigation.hpp"
#include "firmware/wire/n2k/setpoint.hpp"

namespace earshot::board {
namespace {

constexpr std::uint8_t kOwnAddress = 0x40;  ///< NMEA 2000 source address; address claim comes with a later issue

class LcmBus final : public VehicleBus {
 public:
  explicit LcmBus(const MissionFile& mission)
      : endpoint_(parse_lcm_url(mission.lcm_url), {wire::kNavStateChannel, wire::kSnrEstimateChannel, wire::kOperatorCommandChannel}) {}

  void collect(Time /*now*/, runtime::Inputs& inputs) override {
    endpoint_.collect();
    for (wire::Lc02Message message; endpoint_.take(message) == Status::kOk;) take(message, inputs);
  }

  void publish(Time now, const runtime::Outputs& outputs) override {
    count_sent(board::publish(endpoint_, wire::kSetpointChannel, to_message(outputs.setpoint, now)), counters_.setpoint_messages);
    std::uint64_t others_sent = 0;
    if (outputs.decision) count_sent(board::publish(endpoint_, wire::kDecisionChannel, to_message(*outputs.decision)), others_sent);
    count_sent(board::publish(endpoint_, wire::kHealthChannel, to_message(outputs, now)), others_sent);
  }

  [[nodiscard]] int file_descriptor() const override { return endpoint_.file_descriptor(); }

 private:
  template <class Message, class Input>
  void read(const wire::Lc02Message& bytes, std::optional<Input>& input) {
    Message message{};
    if (decode(bytes.data, message) == Status::kOk) {
      input = from_message(message);
    } else {
      ++counters_.refused_messages;
    }
  }

  void take(const wire::Lc02Message& message, runtime::Inputs& inputs) {
    if (message.channel == wire::kNavStateChannel) {
      ++counters_.navigation_messages;
      read<nav_state_t>(message, inputs.navigation);
    } else if (message.channel == wire::kSnrEstimateChannel) {
      read<snr_estimate_t>(message, inputs.snr);
    } else {
      read<operator_command_t>(message, inputs.command);
    }
  }

  LcmEndpoint endpoint_;
};

class CanBus final : public VehicleBus {
 public:
  explicit CanBus(const MissionFile& mission) : socket_(mission.can_interface), receiver_(mission.plane) {}

  void collect(Time now, runtime::Inputs& inputs) override {
    for (n2k::Frame frame; socket_.receive(frame) == Status::kOk;) {
      n2k::Navigation fix;
      const Status status = receiver_.accept(frame, now, fix);
      if (status == Status::kOk) {
        ++counters_.navigation_messages;
        inputs.navigation = {.time = now, .position = fix.position, .depth = fix.depth, .heading = fix.heading, .speed = fix.speed};
      } else if (status != Status::kNotReady) {
        ++counters_.refused_messages;
      }
    }
  }

  void publish(Time /*now*/, const runtime::Outputs& outputs) override {
    const n2k::Setpoint setpoint{.heading = outputs.setpoint.heading, .speed = outputs.setpoint.speed, .depth = outputs.setpoint.depth};
    count_sent(send(setpoint), counters_.setpoint_messages);
  }

  [[nodiscard]] int file_descriptor() const override { return socket_.file_descriptor(); }

 private:
  Status send(const n2k::Setpoint& setpoint) {
    n2k::SetpointFrames frames;
    const Status composed = n2k::compose_setpoint(setpoint, kOwnAddress, sequence_++, frames);
    if (composed != Status::kOk) return composed;
    for (const n2k::Frame& frame : frames) {
      const Status sent = socket_.send(frame);
      if (sent != Status::kOk) return sent;
    }
    return Status::kOk;
  }

  CanSocket socket_;
  n2k::NavigationReceiver receiver_;
  std::uint8_t sequence_ = 0;
};

}  // namespace

std::unique_ptr<VehicleBus> open_vehicle_bus(const MissionFile& mission) {
  if (mission.bus == BusKind::kCan) return std::make_unique<CanBus>(mission);
  return std::make_unique<LcmBus>(mission);
}

}  // namespace earshot::board
