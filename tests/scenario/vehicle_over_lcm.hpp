#pragma once

#include <chrono>
#include <cmath>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "earshot/command_acknowledgement_t.hpp"
#include "earshot/health_t.hpp"
#include "earshot/setpoint_t.hpp"
#include "firmware/boards/linux/clock/host_clock.hpp"
#include "firmware/host/transport/lcm_endpoint.hpp"
#include "firmware/messages/health.hpp"
#include "firmware/messages/operator_command.hpp"
#include "firmware/messages/vehicle_status.hpp"
#include "firmware/wire/lcm/channels.hpp"
#include "firmware/wire/lcm/encoding.hpp"
#include "tests/support/lcm_peer.hpp"

namespace earshot {

/// A vehicle on the LCM bus that obeys at once, its hydrophone and its operator.
class VehicleOverLcm {
 public:
  /// Mission seconds in a second.
  static constexpr double kSpeed = 10.0;

  explicit VehicleOverLcm(const std::string& url)
      : endpoint_(host::parse_lcm_url(url), {wire::kHealthChannel, wire::kSetpointChannel, wire::kAcknowledgementChannel}) {
    fix_.position = {.north = Meters{12'500}, .east = Meters{12'500}};  // the middle of the mission's area
  }

  /// Sails until `is_true`. @return false when it has not come true in a minute
  [[nodiscard]] bool sails_until(const std::function<bool()>& is_true) {
    for (const auto deadline = std::chrono::steady_clock::now() + std::chrono::minutes(1); std::chrono::steady_clock::now() < deadline;) {
      listen();
      if (is_true()) return true;
      send_measurements();
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
      move();
    }
    return false;
  }

  void order(messages::Order order, const messages::OperatorLimits& limits = {}) {
    const Time now = utc();
    messages::OperatorCommand command{
        .time = now, .expiry = now + Duration::seconds(1000), .issuer = 4711, .number = ++orders_, .order = order};
    command.limits = limits;
    outcome.reset();
    publish(wire::kOperatorCommandChannel, command);
  }
  /// Whether there is water in the hull, from now on.
  void leak(bool has_leak = true) { has_leak_ = has_leak; }
  /// Its sensors say nothing, from now on.
  void fall_silent() { is_silent_ = true; }
  /// What no port can read.
  void send_nonsense() {
    const std::vector<std::uint8_t> nonsense(100'000, 0x5A);  // in several datagrams
    (void)endpoint_.publish(wire::kNavStateChannel, nonsense);
    (void)endpoint_.publish("NOBODYS", nonsense);
  }
  void take_new_routes() { endpoint_.refresh_interfaces(); }

  [[nodiscard]] messages::MissionState state() const { return static_cast<messages::MissionState>(health.state); }
  /// That it was told last.
  [[nodiscard]] Meters depth() const { return fix_.depth; }
  health_t health{};
  int turns = 0;                                    ///< health messages heard
  int setpoints = 0;                                ///< likewise
  bool is_released = false;                         ///< the last of them asks for that
  std::optional<messages::CommandOutcome> outcome;  ///< of the last order, once it is answered
  Duration clock_is_ahead;                          ///< its wall clock, and so that of all its devices

 private:
  template <class Message>
  void publish(std::string_view channel, const Message& message) {
    (void)endpoint_.publish(channel, wire::Encoded(message).bytes());  // the network may be down
  }
  void listen() {
    endpoint_.collect();
    for (wire::Lc02Message message; endpoint_.take(message) == Status::kOk;) {
      messages::Setpoint wanted;
      if (message.channel == wire::kHealthChannel && support::read_peer(message.data, health) == Status::kOk) ++turns;
      if (message.channel == wire::kSetpointChannel && wire::decode(message.data, wanted) == Status::kOk) {
        fix_.heading = wanted.heading;
        fix_.speed = wanted.speed;
        fix_.depth = wanted.depth;
        is_released = wanted.release_weight;
        ++setpoints;
      }
      command_acknowledgement_t answer{};
      if (message.channel == wire::kAcknowledgementChannel && support::read_peer(message.data, answer) == Status::kOk &&
          answer.number == static_cast<std::int32_t>(orders_))
        outcome = static_cast<messages::CommandOutcome>(answer.outcome);
    }
  }
  void move() {
    const auto now = std::chrono::steady_clock::now();
    const double travelled_m = fix_.speed.value * kSpeed * std::chrono::duration<double>(now - moved_).count();
    moved_ = now;
    fix_.position.north += Meters{travelled_m * std::cos(fix_.heading.value)};
    fix_.position.east += Meters{travelled_m * std::sin(fix_.heading.value)};
  }
  void send_measurements() {
    if (is_silent_) return;
    fix_.time = utc();
    publish(wire::kNavStateChannel, fix_);
    publish(wire::kSnrEstimateChannel, messages::SnrMeasurement{.time = utc(), .snr = Decibels{3}});
    reports_hull_ = reports_hull_ || has_leak_;
    if (reports_hull_) publish(wire::kVehicleStatusChannel, messages::VehicleStatus{.time = utc(), .has_leak = has_leak_});
  }

  [[nodiscard]] Time utc() const { return clock_.utc() + clock_is_ahead; }

  host::LcmEndpoint endpoint_;
  board::HostClock clock_;
  messages::Navigation fix_;
  std::chrono::steady_clock::time_point moved_ = std::chrono::steady_clock::now();
  std::uint32_t orders_ = 0;
  bool has_leak_ = false;
  bool reports_hull_ = false;
  bool is_silent_ = false;
};

}  // namespace earshot
