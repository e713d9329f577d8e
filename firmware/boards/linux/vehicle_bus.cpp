#include "firmware/boards/linux/vehicle_bus.hpp"

#include <poll.h>

#include <ctime>

#include "firmware/boards/linux/can_socket.hpp"
#include "firmware/boards/linux/lcm_codec.hpp"
#include "firmware/boards/linux/lcm_endpoint.hpp"
#include "firmware/boards/linux/messages.hpp"
#include "firmware/config/capacities.hpp"
#include "firmware/wire/lcm/channels.hpp"
#include "firmware/wire/n2k/navigation.hpp"
#include "firmware/wire/n2k/setpoint.hpp"

namespace earshot::board {
namespace {

void wait_for_input(int file_descriptor, Duration most) {
  constexpr std::int64_t kMicrosecondsPerSecond = 1'000'000;
  pollfd readable{.fd = file_descriptor, .events = POLLIN, .revents = 0};
  const timespec timeout{.tv_sec = most.us / kMicrosecondsPerSecond, .tv_nsec = most.us % kMicrosecondsPerSecond * 1000};
  (void)ppoll(&readable, 1, &timeout, nullptr);
}

class LcmBus final : public VehicleBus {
 public:
  explicit LcmBus(const MissionFile& mission)
      : endpoint_(parse_lcm_url(mission.lcm_url), {wire::kNavStateChannel, wire::kSnrEstimateChannel, wire::kOperatorCommandChannel}) {}

  void collect(Time now, InputSink& sink) override {
    endpoint_.collect();
    for (wire::Lc02Message message; endpoint_.take(message) == Status::kOk;) take(now, message, sink);
  }

  void publish(Time now, const runtime::Outputs& outputs) override {
    count_sent(board::publish(endpoint_, wire::kSetpointChannel, to_message(outputs.setpoint, now)), counters_.setpoint_messages);
    std::uint64_t others_sent = 0;
    if (outputs.decision) count_sent(board::publish(endpoint_, wire::kDecisionChannel, to_message(*outputs.decision)), others_sent);
    count_sent(board::publish(endpoint_, wire::kHealthChannel, to_message(outputs, counters().refused_messages, now)), others_sent);
  }

  void wait(Duration most) override { wait_for_input(endpoint_.file_descriptor(), most); }

 private:
  template <class Message>
  void read(Time now, const wire::Lc02Message& bytes, InputSink& sink) {
    Message message{};
    if (decode(bytes.data, message) == Status::kOk) {
      sink.take(now, from_message(message));
    } else {
      ++counters_.refused_messages;
    }
  }

  void take(Time now, const wire::Lc02Message& message, InputSink& sink) {
    if (message.channel == wire::kNavStateChannel) {
      read<nav_state_t>(now, message, sink);
    } else if (message.channel == wire::kSnrEstimateChannel) {
      read<snr_estimate_t>(now, message, sink);
    } else {
      read<operator_command_t>(now, message, sink);
    }
  }

  [[nodiscard]] std::uint64_t refused_below() const override {
    const LcmCounters lcm = endpoint_.counters();
    return lcm.overwritten + lcm.datagrams.malformed + lcm.datagrams.too_large + lcm.datagrams.incomplete;
  }

  LcmEndpoint endpoint_;
};

class CanBus final : public VehicleBus {
 public:
  explicit CanBus(const MissionFile& mission) : socket_(mission.can_interface), receiver_(mission.plane) {}

  void collect(Time now, InputSink& sink) override {
    std::size_t budget = config::kCanFramesPerCollect;
    for (n2k::Frame frame; socket_.receive(frame, budget) == Status::kOk;) {
      n2k::Navigation fix;
      if (receiver_.accept(frame, now, fix) != Status::kOk) continue;
      sink.take(now,
                runtime::Navigation{.time = now, .position = fix.position, .depth = fix.depth, .heading = fix.heading, .speed = fix.speed});
    }
  }

  void publish(Time /*now*/, const runtime::Outputs& outputs) override {
    const n2k::Setpoint setpoint{.heading = outputs.setpoint.heading, .speed = outputs.setpoint.speed, .depth = outputs.setpoint.depth};
    count_sent(send(setpoint), counters_.setpoint_messages);
  }

  void wait(Duration most) override { wait_for_input(socket_.file_descriptor(), most); }

 private:
  Status send(const n2k::Setpoint& setpoint) {
    n2k::SetpointFrames frames;
    const Status composed = n2k::compose_setpoint(setpoint, n2k::kRuntimeAddress, sequence_++, frames);
    if (composed != Status::kOk) return composed;
    for (const n2k::Frame& frame : frames) {
      const Status sent = socket_.send(frame);
      if (sent != Status::kOk) return sent;
    }
    return Status::kOk;
  }

  [[nodiscard]] std::uint64_t refused_below() const override {
    return socket_.counters().lost_by_kernel + receiver_.counters().refused + receiver_.counters().waiting;
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
