#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <string>

#include "firmware/messages/operator_command.hpp"
#include "firmware/messages/setpoint.hpp"
#include "firmware/wire/n2k/fast_packet.hpp"
#include "firmware/wire/n2k/node/information.hpp"
#include "firmware/wire/n2k/node/node.hpp"
#include "firmware/wire/n2k/own/conditions.hpp"
#include "firmware/wire/n2k/own/measurements.hpp"
#include "firmware/wire/n2k/own/orders.hpp"
#include "firmware/wire/n2k/own/reports.hpp"
#include "firmware/wire/n2k/sensors/fields.hpp"
#include "firmware/wire/n2k/setpoint.hpp"
#include "firmware/wire/n2k/vehicle_state/navigation.hpp"
#include "firmware/wire/n2k/vehicle_state/vehicle_condition.hpp"

namespace earshot::fuzz {

/// Everything on a vehicle that reads CAN frames, and what it must never make of them.
class FrameReaders {
 public:
  /// @param now  never goes back
  /// @return what was made of the frame that cannot be; nullptr when all is well
  [[nodiscard]] const char* take(const n2k::Frame& frame, Time now) {
    const char* wrong = navigate(frame, now);
    if (wrong == nullptr) wrong = obey(frame, now);
    if (wrong == nullptr) wrong = steer(frame);
    if (wrong == nullptr) wrong = report(frame, now);
    if (wrong == nullptr) wrong = answer(frame, now);
    return wrong;
  }

  [[nodiscard]] std::string account() const {
    return std::to_string(fixes_) + " fixes, " + std::to_string(commands_) + " commands, " + std::to_string(sent_) +
           " frames sent by the node";
  }
  [[nodiscard]] bool has_seen_all() const { return fixes_ > 0 && commands_ > 0 && sent_ > 0; }

 private:
  static constexpr double kPi = 3.141592653589793;

  static n2k::Identity identity() {
    n2k::Identity identity;
    identity.name = n2k::name_of({.unique_number = 1}).value();
    return identity;
  }

  static bool is_sound(const n2k::Fix& fix) {
    return is_finite(fix.position) && std::abs(fix.heading.value) <= kPi && std::abs(fix.depth.value) < 30'000.0 &&
           (!fix.speed || (fix.speed->value >= 0.0 && fix.speed->value < 656.0));
  }

  static bool is_sound(const n2k::Readings& readings) {
    if (readings.heading && !(std::abs(readings.heading->value.value) <= kPi)) return false;
    if (readings.position && !(std::abs(readings.position->value.latitude_deg) <= 90.0)) return false;
    if (readings.altitude && !(readings.altitude->value.value >= 0.0)) return false;
    if (readings.rate_of_turn && !(std::abs(readings.rate_of_turn->value.value) < 68.0)) return false;
    return !readings.over_ground || readings.over_ground->value.speed.value >= 0.0;
  }

  /// NaN is not known.
  static bool is_sound(const messages::VehicleStatus& status, Time now) {
    return status.time <= now && !(status.altitude.value < 0.0) && !(status.battery_percent < 0.0) && !(status.battery_percent > 100.0);
  }

  const char* navigate(const n2k::Frame& frame, Time now) {
    n2k::Fix fix;
    if (receiver_.accept(frame, now, fix) == Status::kOk) {
      ++fixes_;
      if (!is_sound(fix) || fix.time > now) return "a fix that cannot be";
    }
    static_cast<void>(receiver_.zero_at_surface());
    static_cast<void>(condition_.accept_hull(frame, receiver_.sensors().directory(), now));
    messages::VehicleStatus status;
    if (condition_.give(receiver_.sensors(), now, status) == Status::kOk && !is_sound(status, now)) return "a status that cannot be";
    return is_sound(receiver_.sensors().readings()) ? nullptr : "a reading that cannot be";
  }

  const char* obey(const n2k::Frame& frame, Time now) {
    messages::OperatorCommand command;
    std::uint8_t sender = 0;
    if (orders_.accept(frame, now, n2k::kRuntimeAddress, command, sender) != Status::kOk) return nullptr;
    ++commands_;
    const bool is_to_all = n2k::parse_identifier(frame.identifier).value().destination == n2k::kBroadcast;
    return is_to_all && command.order != messages::Order::kAbort ? "an order to all that is no abort" : nullptr;
  }

  const char* steer(const n2k::Frame& frame) {
    messages::Setpoint setpoint;
    if (setpoints_.accept(frame, setpoint) != Status::kOk) return nullptr;
    const bool is_sound = std::abs(setpoint.heading.value) <= kPi && std::abs(setpoint.speed.value) < 656.0;
    return is_sound ? nullptr : "a wild set-point";
  }

  /// What the vehicle measures and says of itself, as another device reads it.
  const char* report(const n2k::Frame& frame, Time now) {
    static_cast<void>(n2k::read_snr(frame.bytes()));
    static_cast<void>(n2k::read_deaf(frame.bytes()));
    static_cast<void>(n2k::read_autopilot_status(frame.bytes()));
    n2k::Assembled message;
    const Result<n2k::Identifier> identifier = n2k::parse_identifier(frame.identifier);
    if (!identifier.ok() || packets_.accept(identifier.value(), frame, now, message) != Status::kOk) return nullptr;
    if (message.bytes.empty() || message.bytes.size() > n2k::kMaxMessageSize || message.began > now) return "a packet that cannot be";
    static_cast<void>(n2k::fields::reference_stations(message.bytes));
    static_cast<void>(n2k::read_command(message.bytes));
    static_cast<void>(n2k::read_acknowledgement(message.bytes));
    static_cast<void>(n2k::read_health(message.bytes));
    static_cast<void>(n2k::read_port_health(message.bytes));
    const Result<messages::Decision> decision = n2k::read_decision(message.bytes);
    return !decision.ok() || is_finite(decision.value().position) ? nullptr : "a decision that cannot be";
  }

  const char* answer(const n2k::Frame& frame, Time now) {
    node_.accept(frame, now);
    n2k::NodeFrames frames;
    node_.step(now, frames);
    sent_ += frames.size();
    for (const n2k::Frame& sent : frames) {
      const Result<n2k::Identifier> identifier = n2k::parse_identifier(sent.identifier);
      if (!identifier.ok() || sent.size > 8) return "the node sends what is no frame";
      const std::uint8_t source = identifier.value().source;
      if (source > n2k::kLastAddress && source != n2k::kNullAddress) return "the node sends from a wrong source";
    }
    return nullptr;
  }

  n2k::NavigationReceiver receiver_{n2k::LocalPlane{}, {.sensors = {}, .oldest_part = Duration::seconds(60)}};
  n2k::VehicleCondition condition_{Duration::seconds(3)};
  n2k::OrderReceiver orders_;
  n2k::SetpointReceiver setpoints_;
  n2k::FastPacketAssembly packets_;
  n2k::Node node_{identity(), n2k::table_pgns(n2k::PgnListKind::kTransmitted), n2k::table_pgns(n2k::PgnListKind::kReceived)};
  std::uint64_t fixes_ = 0;
  std::uint64_t commands_ = 0;
  std::uint64_t sent_ = 0;
};

}  // namespace earshot::fuzz
