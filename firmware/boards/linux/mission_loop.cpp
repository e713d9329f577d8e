#include "firmware/boards/linux/mission_loop.hpp"

#include <algorithm>
#include <chrono>
#include <optional>

#include "firmware/boards/linux/sender_clock.hpp"

namespace earshot::board {
namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

constexpr milliseconds kLookUp{100};                      ///< how often a waiting loop looks at `stop`
constexpr Duration kPause = Duration::milliseconds(100);  ///< likewise, while waiting for the bus
constexpr milliseconds kBusPatience{2000};                ///< for navigation that was sent before its tick: on one host it is there already

bool is_over(const runtime::Outputs& outputs) {
  return outputs.state == runtime::MissionState::kDone || outputs.state == runtime::MissionState::kAbort;
}

/// What arrives in one tick. Everything is dated with its tick: what is not was meant for another flight.
class TickInputs final : public InputSink {
 public:
  TickInputs(MissionTurn& turn, VehicleBus& bus) : turn_(turn), bus_(bus) {}

  void take(Time now, const runtime::Navigation& navigation) override {
    if (navigation.time != now) return bus_.count_refused();
    ++fixes_;
    turn_.take(now, navigation);
  }
  void take(Time now, const runtime::SnrEstimate& estimate) override {
    if (estimate.time != now) return bus_.count_refused();
    turn_.take(now, estimate);
  }
  void take(Time now, runtime::OperatorCommand command) override { turn_.take(now, command); }

  [[nodiscard]] std::uint64_t fixes() const { return fixes_; }

 private:
  MissionTurn& turn_;
  VehicleBus& bus_;
  std::uint64_t fixes_ = 0;
};

/// Collects until as many fixes have come as the tick announces.
bool collect_announced(VehicleBus& bus, Time now, std::uint64_t fixes, TickInputs& inputs) {
  bus.collect(now, inputs);
  if (inputs.fixes() >= fixes) return true;
  const auto deadline = steady_clock::now() + kBusPatience;
  while (inputs.fixes() < fixes) {
    if (steady_clock::now() >= deadline) return false;
    bus.wait(kPause);
    bus.collect(now, inputs);
  }
  return true;
}

/// After what came over the bus: of two SNR with one date the simulator's is the later, and thus the one that counts.
void take_tick(const link::Tick& tick, MissionTurn& turn) {
  if (tick.snr) turn.take(tick.time, runtime::SnrEstimate{.time = tick.time, .snr = *tick.snr, .measured = !tick.snr_too_faint});
  if (tick.command != 0) turn.take(tick.time, static_cast<runtime::OperatorCommand>(tick.command));
}

link::Answer answer_to(const link::Tick& tick, const runtime::Outputs& outputs, const BusCounters& bus) {
  return {.number = tick.number,
          .setpoint_messages = bus.setpoint_messages,
          .steps_taken = outputs.steps_taken,
          .state = static_cast<std::uint8_t>(outputs.state),
          .end_reason = static_cast<std::uint8_t>(outputs.end_reason)};
}

/// UTC when it is made; after that it only runs on.
class MissionClock {
 public:
  explicit MissionClock(const HostClock& host) : host_(host), began_(host.utc()), began_on_host_(host.monotonic()) {}
  [[nodiscard]] Time now() const { return began_ + (host_.monotonic() - began_on_host_); }

 private:
  const HostClock& host_;
  Time began_;
  Duration began_on_host_;
};

/// What arrives at sea, moved to mission time.
class SeaInputs final : public InputSink {
 public:
  SeaInputs(MissionTurn& turn, VehicleBus& bus, const SeaTiming& timing)
      : turn_(turn), bus_(bus), navigation_clock_(timing.navigation_timeout), snr_clock_(timing.snr_timeout) {}

  void take(Time now, const runtime::Navigation& navigation) override { take_moved(now, navigation, navigation_clock_); }
  void take(Time now, const runtime::SnrEstimate& estimate) override { take_moved(now, estimate, snr_clock_); }
  void take(Time now, runtime::OperatorCommand command) override { turn_.take(now, command); }

 private:
  template <class Input>
  void take_moved(Time now, Input input, SenderClock& clock) {
    const std::optional<Time> time = clock.to_mission_time(input.time, now);
    if (!time) return bus_.count_refused();
    input.time = *time;
    turn_.take(now, input);
  }

  MissionTurn& turn_;
  VehicleBus& bus_;
  SenderClock navigation_clock_;
  SenderClock snr_clock_;
};

}  // namespace

LoopResult fly_in_simulation(MissionTurn& turn, VehicleBus& bus, link::RuntimeEnd& link, const std::atomic<bool>& stop) {
  LoopResult result;
  std::uint64_t fixes_before = 0;
  while (stop == 0) {
    link::Tick tick;
    const link::Delivery delivery = link.receive(tick, kLookUp);
    if (delivery == link::Delivery::kNothing) continue;
    if (delivery == link::Delivery::kLost) return result.end = LoopEnd::kSimulatorLost, result;
    TickInputs inputs(turn, bus);
    if (!collect_announced(bus, tick.time, tick.navigation_messages - fixes_before, inputs)) return result.end = LoopEnd::kBusLost, result;
    if (fixes_before == 0) result.began = tick.time;
    fixes_before = tick.navigation_messages;
    take_tick(tick, turn);
    result.time = tick.time;
    result.last = turn(tick.time);
    link.send(answer_to(tick, result.last, bus.counters()));
    if (is_over(result.last)) return result.end = LoopEnd::kMissionOver, result;
  }
  return result;
}

LoopResult fly_at_sea(MissionTurn& turn, VehicleBus& bus, const HostClock& host, const SeaTiming& timing, const std::atomic<bool>& stop) {
  const MissionClock clock(host);
  SeaInputs inputs(turn, bus, timing);
  LoopResult result;
  result.began = clock.now();
  Time next_turn = result.began;
  while (stop == 0) {
    next_turn = next_turn + timing.period;
    for (Time now = clock.now(); now < next_turn && stop == 0; now = clock.now()) {
      bus.wait(std::min(kPause, next_turn - now));
      bus.collect(clock.now(), inputs);
    }
    if (stop != 0) break;
    if (clock.now() > next_turn + timing.period) next_turn = clock.now();  // missed turns are not made up for
    bus.collect(clock.now(), inputs);                                      // after a stall nothing has been collected yet
    result.time = clock.now();
    result.last = turn(result.time);
  }
  result.time = clock.now();
  if (!is_over(result.last)) turn.take(result.time, runtime::OperatorCommand::kAbort);
  result.last = turn(result.time);
  return result;
}

}  // namespace earshot::board
