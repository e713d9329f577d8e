#include "firmware/boards/linux/mission_loop.hpp"

#include <poll.h>

#include <algorithm>
#include <chrono>

namespace earshot::board {
namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

constexpr milliseconds kLookUp{100};        ///< how often a waiting loop looks at `stop`
constexpr milliseconds kBusPatience{2000};  ///< for navigation that was sent before its tick: on one host it is there already

bool is_over(const runtime::Outputs& outputs) {
  return outputs.state == runtime::MissionState::kDone || outputs.state == runtime::MissionState::kAbort;
}

void wait_for_input(const VehicleBus& bus, milliseconds timeout) {
  pollfd readable{.fd = bus.file_descriptor(), .events = POLLIN, .revents = 0};
  (void)poll(&readable, 1, static_cast<int>(timeout.count()));
}

/// Collects until as many fixes have come as the tick announces.
bool collect_announced(VehicleBus& bus, const link::Tick& tick, runtime::Inputs& inputs) {
  bus.collect(tick.time, inputs);
  if (bus.counters().navigation_messages >= tick.navigation_messages) return true;
  const auto deadline = steady_clock::now() + kBusPatience;
  while (bus.counters().navigation_messages < tick.navigation_messages) {
    if (steady_clock::now() >= deadline) return false;
    wait_for_input(bus, kLookUp);
    bus.collect(tick.time, inputs);
  }
  return true;
}

/// The simulator's word comes first: an order or an SNR on the bus does not replace what the tick says.
void take_tick(const link::Tick& tick, runtime::Inputs& inputs) {
  if (tick.snr) inputs.snr = runtime::SnrEstimate{.time = tick.time, .snr = *tick.snr};
  if (tick.command != 0) inputs.command = static_cast<runtime::OperatorCommand>(tick.command);
}

link::Answer answer_to(const link::Tick& tick, const runtime::Outputs& outputs, const BusCounters& bus) {
  return {.number = tick.number,
          .setpoint_messages = bus.setpoint_messages,
          .steps_taken = outputs.steps_taken,
          .state = static_cast<std::uint8_t>(outputs.state),
          .end_reason = static_cast<std::uint8_t>(outputs.end_reason)};
}

/// The host's clock, kept from going back.
Time host_time(Time last) {
  const auto since_epoch = std::chrono::system_clock::now().time_since_epoch();
  return std::max(last, Time{std::chrono::duration_cast<std::chrono::microseconds>(since_epoch).count()});
}

}  // namespace

LoopResult fly_in_simulation(MissionTurn& turn, VehicleBus& bus, link::RuntimeEnd& link, const volatile std::sig_atomic_t& stop) {
  LoopResult result;
  while (stop == 0) {
    link::Tick tick;
    const link::Delivery delivery = link.receive(tick, kLookUp);
    if (delivery == link::Delivery::kNothing) continue;
    if (delivery == link::Delivery::kLost) return result.end = LoopEnd::kSimulatorLost, result;
    runtime::Inputs inputs;
    if (!collect_announced(bus, tick, inputs)) return result.end = LoopEnd::kBusLost, result;
    take_tick(tick, inputs);
    result.time = tick.time;
    result.last = turn(tick.time, inputs);
    link.send(answer_to(tick, result.last, bus.counters()));
    if (is_over(result.last)) return result.end = LoopEnd::kMissionOver, result;
  }
  return result;
}

LoopResult fly_at_sea(MissionTurn& turn, VehicleBus& bus, Duration period, const volatile std::sig_atomic_t& stop) {
  LoopResult result;
  auto next_turn = steady_clock::now();
  runtime::Inputs inputs;
  while (stop == 0) {
    next_turn += std::chrono::microseconds(period.us);
    for (auto now = steady_clock::now(); now < next_turn && stop == 0; now = steady_clock::now()) {
      wait_for_input(bus, std::min(kLookUp, std::chrono::ceil<milliseconds>(next_turn - now)));
      bus.collect(host_time(result.time), inputs);
    }
    result.time = host_time(result.time);
    result.last = turn(result.time, inputs);
    inputs = {};
  }
  return result;
}

}  // namespace earshot::board
