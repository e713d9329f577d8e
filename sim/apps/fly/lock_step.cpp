#include "sim/apps/fly/lock_step.hpp"

#include <chrono>
#include <exception>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <utility>

#include "firmware/boards/linux/waiting.hpp"
#include "firmware/host/program/live_line.hpp"
#include "firmware/messages/dictionary/mission_words.hpp"
#include "firmware/runtime/runtime.hpp"
#include "sim/apps/fly/flight_progress.hpp"

namespace earshot::fly {
namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

/// Of the seed; the start is drawn from stream 0.
constexpr std::uint64_t kConditionsStream = 1;
/// How often a waiting simulator looks at `stop`.
constexpr milliseconds kPollInterval{100};
/// For a set-point that was sent before its answer.
constexpr milliseconds kBusPatience{2000};

/// One word of summary.json. The simulator aborts when it is interrupted, and else nobody does.
std::string word_for(messages::EndReason reason) {
  return reason == messages::EndReason::kOperatorAbort ? "interrupted" : std::string(messages::key_of(reason));
}

/// One flight in the making.
class Stepper {
 public:
  Stepper(const Flight& flight, const vehicle::State& start, const std::atomic<bool>& stop)
      : flight_(flight), vehicle_(start), command_{.heading = start.heading, .speed = start.speed, .depth = start.depth}, stop_(stop) {
    result_.battery = flight.setup.battery;
    surroundings_.start(flight.setup.world, start.position, flight.setup.source, Pcg32(flight.setup.seed, kConditionsStream));
    if (flight.sound != nullptr) sound_ = std::make_unique<Sound>(*flight.sound, surroundings_, flight.setup.tick);
    source_ = surroundings_.nearest_source(start.position);
  }

  FlightResult run() {
    const auto began = steady_clock::now();
    try {
      fly(began);
    } catch (const std::exception& e) {
      fail("simulator_failed", e.what());
    }
    result_.last_tick = now_;
    result_.wall_time_s = std::chrono::duration<double>(steady_clock::now() - began).count();
    result_.end = vehicle_;
    result_.sound = std::move(sound_);
    return std::move(result_);
  }

 private:
  void fly(steady_clock::time_point began) {
    for (;;) {
      tick();
      if (over_) return;
      advance();
      now_ = now_ + flight_.setup.tick;
      keep_pace(began);
    }
  }

  void advance() {
    const NorthEast before = vehicle_.position;
    vehicle_ = vehicle::advance_for(vehicle_, command_, flight_.setup.vehicle, flight_.setup.tick);
    if (result_.battery) result_.battery->sail(range_between(before, vehicle_.position));
    vehicle_.position = surroundings_.carry(flight_.setup.world, before, vehicle_.position, flight_.setup.tick.to_seconds());
    source_ = surroundings_.nearest_source(vehicle_.position);
  }

  /// What navigation tells of the vehicle.
  [[nodiscard]] vehicle::State believed() const {
    vehicle::State state = vehicle_;
    state.position = state.position + surroundings_.navigation_error();
    return state;
  }

  void tick() {
    const Meters range = range_between(vehicle_.position, source_);
    const policy::Reception reception = listen();
    const bool reached = flight_.setup.may_be_found && range <= flight_.setup.found_within;
    flight_.bus.publish(now_, believed());
    const link::Tick tick{.number = ++number_,
                          .time = now_,
                          .navigation_messages = flight_.bus.navigation_messages() - sent_again_,
                          .hydrophone_blocks = sound_ ? sound_->blocks() : 0,
                          .snr = sound_ ? std::nullopt : std::optional(reception.snr),
                          .snr_too_faint = !sound_ && reception.too_faint,
                          .bearing = reception.bearing,
                          .command = order(reached),
                          .battery_percent = result_.battery ? std::optional(result_.battery->percent) : std::nullopt};
    flight_.link.send(tick);
    flight_.link.observe({.time = now_,
                          .vehicle = vehicle_.position,
                          .vehicle_depth = vehicle_.depth,
                          .vehicle_heading = vehicle_.heading,
                          .source = source_,
                          .range = range});
    link::Answer answer;
    if (!receive(tick, answer) || !collect(answer)) return;
    const TrackPoint point{.time = now_,
                           .vehicle = vehicle_,
                           .reception = reception,
                           .range = range,
                           .state = static_cast<messages::MissionState>(answer.state),
                           .steps_taken = answer.steps_taken};
    result_.account.note(answer, range);
    record(point, answer);
    if (sound_) sound_->note_motion(vehicle_.speed);
    if (live_.is_due()) show(point, answer.believed_source);
  }

  /// The modelled reception; in a flight that hears its sound has gone over the bus.
  policy::Reception listen() {
    const search::World& world = flight_.setup.world;
    if (!sound_) {
      const policy::Reception reception = surroundings_.listen(world, vehicle_.position);
      flight_.score.hear({.time = now_, .snr = reception.snr, .too_faint = reception.too_faint});
      return heard_ = reception;
    }
    const search::Arrivals arrivals = surroundings_.arrivals(world, vehicle_.position);
    const policy::Reception modelled = surroundings_.reception_of(world, arrivals);
    sound_->pass(now_, arrivals, modelled, vehicle_.speed);
    for (const messages::SnrMeasurement& measurement : sound_->measurements()) {
      flight_.score.hear(measurement);
      heard_ = {.snr = measurement.snr, .too_faint = measurement.too_faint};
    }
    return modelled;
  }

  void show(const TrackPoint& point, const std::optional<NorthEast>& believed_source) {
    const auto range_from_here = [this](NorthEast source) { return range_between(believed().position, source); };
    live_.draw(to_string({.at_sea = point.time - Time{},
                          .steps_taken = point.steps_taken,
                          .max_steps = flight_.setup.world.settings.max_steps,
                          .reception = heard_,
                          .is_learning_noise = sound_ && !sound_->has_heard(),
                          .believed_range = believed_source ? std::optional(range_from_here(*believed_source)) : std::nullopt}));
  }

  [[nodiscard]] std::uint8_t order(bool reached) const {
    if (stop_) return static_cast<std::uint8_t>(messages::Order::kAbort);
    if (state_ == messages::MissionState::kStandby && (!sound_ || sound_->has_heard()))
      return static_cast<std::uint8_t>(messages::Order::kStart);
    return reached ? static_cast<std::uint8_t>(messages::Order::kComplete) : std::uint8_t{0};
  }

  [[nodiscard]] bool receive(const link::Tick& tick, link::Answer& answer) {
    for (;;) {
      const char* const lost = wait_for_answer(answer);
      if (lost == nullptr) return true;
      if (!has_returned()) return fail("earshotd_lost", std::string("lost earshotd (") + lost + ")");
      if (!send_again(tick)) return false;
    }
  }

  /// @return null, or how the runtime was lost
  [[nodiscard]] const char* wait_for_answer(link::Answer& answer) {
    for (auto waited = milliseconds{0}; waited < flight_.setup.answer_patience; waited += kPollInterval) {
      const link::Delivery delivery = flight_.link.receive(answer, kPollInterval);
      if (delivery == link::Delivery::kLost) return "it left or died";
      if (delivery == link::Delivery::kArrived && answer.number == number_) return nullptr;
    }
    return "it does not answer";
  }

  [[nodiscard]] bool has_returned() {
    if (flight_.setup.wait_for_runtime.count() == 0 || sound_) return false;
    flight_.link.give_up_runtime();
    return board::wait_for("earshot-sim", "the return of earshotd (lost at " + std::to_string(now_.us / 1'000'000) + " s)",
                           flight_.setup.wait_for_runtime,
                           [this](milliseconds most) { return flight_.link.wait_for_runtime(most); }) == board::Waited::kCame;
  }

  /// To a runtime that goes on from its journal: that holds the tick's turn, whose answer may be lost, or all turns before it.
  [[nodiscard]] bool send_again(const link::Tick& tick) {
    const std::uint64_t turns_made = flight_.link.turns_made();
    if (turns_made != number_ && turns_made + 1 != number_)
      return fail("earshotd_lost", "earshotd came back with " + std::to_string(turns_made) + " turns in its journal, and had made " +
                                       std::to_string(number_ - 1) + " (earshotd goes on with --resume)");
    flight_.bus.collect(command_);
    setpoints_before_ = flight_.bus.setpoint_messages();
    if (turns_made + 1 == number_) {
      const std::uint64_t before = flight_.bus.navigation_messages();
      flight_.bus.publish(now_, believed());
      sent_again_ += flight_.bus.navigation_messages() - before;
    }
    flight_.link.send(tick);
    return true;
  }

  [[nodiscard]] bool collect(const link::Answer& answer) {
    flight_.bus.collect(command_);
    const auto deadline = steady_clock::now() + kBusPatience;
    while (flight_.bus.setpoint_messages() - setpoints_before_ < answer.setpoint_messages) {
      if (steady_clock::now() >= deadline) return fail("bus_lost", "lost the bus (a set-point that earshotd sent did not arrive)");
      flight_.bus.wait(Duration::milliseconds(kPollInterval.count()));
      flight_.bus.collect(command_);
    }
    return true;
  }

  bool fail(const char* reason, const std::string& what) {
    over_ = true;
    result_.end_reason = reason;
    result_.failure = what;
    return false;
  }

  void record(const TrackPoint& point, const link::Answer& answer) {
    flight_.track.add(point);
    flight_.score.add(point);
    if (state_ == messages::MissionState::kStandby) result_.search_began = point.time;
    state_ = point.state;
    over_ = point.state == messages::MissionState::kDone || point.state == messages::MissionState::kAbort;
    if (!over_) return fail_when_nothing_is_heard();
    const auto reason = static_cast<messages::EndReason>(answer.end_reason);
    const bool is_declared = reason == messages::EndReason::kFound;
    result_.found = reason == messages::EndReason::kCompleted || (is_declared && point.range <= flight_.setup.found_within);
    result_.end_reason = word_for(reason);
    const bool is_ended_by_rule = answer.rule && answer.rule->response >= config::Response::kAbort;
    if (is_ended_by_rule && reason != messages::EndReason::kOperatorAbort) result_.ending_rule = answer.rule;
  }

  void fail_when_nothing_is_heard() {
    if (!sound_ || sound_->has_heard() || now_ - Time{} <= sound_->patience()) return;
    fail("nothing_heard", std::string("the vehicle's detector gave no SNR: ") + sound_->in_the_way());
  }

  void keep_pace(steady_clock::time_point began) const {
    if (flight_.setup.speed <= 0.0) return;
    const auto due = began + std::chrono::duration_cast<steady_clock::duration>(
                                 std::chrono::duration<double>((now_ - Time{}).to_seconds() / flight_.setup.speed));
    while (!stop_ && steady_clock::now() < due) std::this_thread::sleep_until(std::min(due, steady_clock::now() + kPollInterval));
  }

  Flight flight_;
  vehicle::State vehicle_;
  vehicle::Command command_;
  NorthEast source_;
  search::Surroundings surroundings_;
  std::unique_ptr<Sound> sound_;
  policy::Reception heard_;                                          ///< by the vehicle: the newest measurement
  messages::MissionState state_ = messages::MissionState::kStandby;  ///< by the last answer
  const std::atomic<bool>& stop_;
  Time now_;
  std::uint64_t number_ = 0;
  std::uint64_t sent_again_ = 0;        ///< fixes, to a runtime that had lost them
  std::uint64_t setpoints_before_ = 0;  ///< of runtimes before this one
  bool over_ = false;
  FlightResult result_;
  program::LiveLine live_;
};

}  // namespace

FlightResult fly_in_lock_step(Flight flight, const vehicle::State& start, const std::atomic<bool>& stop) {
  return Stepper(flight, start, stop).run();
}

}  // namespace earshot::fly
