#include "sim/link/lock_step_clock.hpp"

namespace earshot::link {
namespace {

constexpr std::chrono::milliseconds kPollInterval{100};   ///< how often a waiting loop looks whether it is to stop
constexpr std::chrono::milliseconds kPortPatience{2000};  ///< for what was sent before its tick: on one host it is there already
constexpr std::uint32_t kIssuer = 0x53494d;               ///< "SIM": of the simulator's orders

/// The strongest that begins to act, of equals the first: the supervisor's own choice. Of those that end the search, for good or for as
/// long as they act.
std::optional<messages::SafetyEvent> stopping_rule(const runtime::Outputs& outputs) {
  std::optional<messages::SafetyEvent> strongest;
  for (const messages::SafetyEvent& event : outputs.safety_events) {
    if (event.begins && event.response >= config::Response::kReturn && (!strongest || event.response > strongest->response))
      strongest = event;
  }
  return strongest;
}

}  // namespace

board::Clock::Wake LockStepClock::wait(const Awaited& awaited) {
  if (!is_waiting_) return receive();
  const bool has_navigation = awaited.navigation_taken >= tick_.navigation_messages;
  const bool has_sound = awaited.blocks_heard >= tick_.hydrophone_blocks;
  if (has_navigation && has_sound) {
    is_waiting_ = false;
    is_due_ = true;
    return Wake::kTurn;
  }
  if (steady_clock::now() >= deadline_) {
    lost_ = !has_navigation ? "the bus: navigation that the simulator sent did not arrive"
                            : "the hydrophone's bus: sound that the simulator sent was not heard (earshotd listens to it with --hear)";
    return Wake::kLost;
  }
  board::wait_for_ports(awaited.ports, Duration::milliseconds(kPollInterval.count()));
  return Wake::kPorts;
}

board::Clock::Wake LockStepClock::receive() {
  Tick tick;
  const Delivery delivery = link_.receive(tick, kPollInterval);
  if (delivery == Delivery::kLost) {
    lost_ = "the simulator";
    return Wake::kLost;
  }
  // What has come meanwhile belongs to the tick that follows it: it is read when that is here.
  if (delivery == Delivery::kNothing) return Wake::kNothing;
  tick_ = tick;
  if (turns_made_ > 0 && tick.number == turns_made_) return Wake::kAgain;
  is_waiting_ = true;
  deadline_ = steady_clock::now() + kPortPatience;
  return Wake::kPorts;
}

void LockStepClock::go_on_after(const messages::Health& last) {
  turns_made_ = last.turn;
  link_.go_on_after(last.turn);
}

Time LockStepClock::time_heard(Time utc) {
  const bool is_of_this_flight = utc >= Time{} && utc <= tick_.time;
  return is_of_this_flight ? utc : Time{-1};
}

std::string LockStepClock::remark() const {
  if (link_.strangers() == 0) return {};
  return std::to_string(link_.strangers()) + " ticks of another simulator in DDS domain " + std::to_string(domain_) + " were ignored";
}

bool LockStepClock::answered(const runtime::Outputs& outputs, std::uint64_t setpoints_sent) {
  if (outputs.decision && outputs.decision->belief) believed_source_ = outputs.decision->belief->likeliest;
  link_.send({.number = tick_.number,
              .setpoint_messages = setpoints_sent,
              .steps_taken = outputs.health.steps_taken,
              .state = static_cast<std::uint8_t>(outputs.health.state),
              .end_reason = static_cast<std::uint8_t>(outputs.health.end_reason),
              .believed_source = believed_source_,
              .mismatch_bits = outputs.health.mismatch_bits,
              .is_sweeping = outputs.health.is_sweeping,
              .is_found = outputs.health.is_found,
              .rule = stopping_rule(outputs)});
  return outputs.health.state != messages::MissionState::kDone && outputs.health.state != messages::MissionState::kAbort;
}

std::optional<Tick> LockStepClock::take_due() {
  if (!is_due_) return std::nullopt;
  is_due_ = false;
  return tick_;
}

void give_inputs(const Tick& tick, std::uint8_t port, board::InputSink& sink) {
  if (tick.bearing) sink.take(port, messages::BearingMeasurement{.time = tick.time, .bearing = *tick.bearing});
  if (tick.snr) sink.take(port, messages::SnrMeasurement{.time = tick.time, .snr = *tick.snr, .too_faint = tick.snr_too_faint});
  if (tick.battery_percent)
    sink.take(port,
              messages::VehicleStatus{
                  .time = tick.time, .altitude = Meters{messages::VehicleStatus::kUnknown}, .battery_percent = *tick.battery_percent});
  if (tick.command != 0) {
    sink.take(port, messages::OperatorCommand{.time = tick.time,
                                              .expiry = tick.time,
                                              .issuer = kIssuer,
                                              .number = static_cast<std::uint32_t>(tick.number),
                                              .order = static_cast<messages::Order>(tick.command),
                                              .is_verified = true});  // it drives the clock: nobody else is there to give orders
  }
}

void LockStepPort::collect(board::Clock& /*clock*/, board::InputSink& sink) {
  if (const std::optional<Tick> tick = clock_.take_due()) give_inputs(*tick, index(), sink);
}

}  // namespace earshot::link
