#include "firmware/boards/linux/lcm_port.hpp"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "firmware/config/capacities.hpp"
#include "firmware/wire/lcm/channels.hpp"
#include "firmware/wire/lcm/conversion.hpp"
#include "firmware/wire/lcm/encoding.hpp"

namespace earshot::board {
namespace {

std::vector<std::string_view> channels_of(host::Roles roles) {
  std::vector<std::string_view> channels;
  if (roles.has(host::Role::kNavigation)) channels.push_back(wire::kNavStateChannel);
  if (roles.has(host::Role::kSnr)) channels.push_back(wire::kSnrEstimateChannel);
  if (roles.has(host::Role::kOperator)) channels.push_back(wire::kOperatorCommandChannel);
  return channels;
}

/// However many orders follow it before they are taken.
bool is_abort(std::string_view channel, std::span<const std::uint8_t> data) {
  operator_command_t command{};
  return channel == wire::kOperatorCommandChannel && wire::decode(data, command) == Status::kOk &&
         command.command == operator_command_t::ABORT;
}

}  // namespace

LcmPort::LcmPort(std::uint8_t index, const host::PortSettings& settings, host::IfMissing if_missing)
    : Port(index, settings.roles),
      name_(settings.name),
      address_(settings.address),
      endpoint_(host::parse_lcm_url(settings.address), channels_of(settings.roles), is_abort, if_missing) {}

void LcmPort::collect(Clock& clock, InputSink& sink) {
  endpoint_.collect();
  for (wire::Lc02Message message; endpoint_.take(message) == Status::kOk;) take(clock, message, sink);
}

void LcmPort::take(Clock& clock, const wire::Lc02Message& message, InputSink& sink) {
  nav_state_t navigation{};
  snr_estimate_t measurement{};
  operator_command_t command{};
  if (message.channel == wire::kNavStateChannel && wire::decode(message.data, navigation) == Status::kOk) {
    messages::Navigation value = wire::from_message(navigation);
    value.time = clock.mission_time_of(value.time);
    sink.take(index(), value);
  } else if (message.channel == wire::kSnrEstimateChannel && wire::decode(message.data, measurement) == Status::kOk) {
    messages::SnrMeasurement value = wire::from_message(measurement);
    value.time = clock.mission_time_of(value.time);
    sink.take(index(), value);
  } else if (message.channel == wire::kOperatorCommandChannel && wire::decode(message.data, command) == Status::kOk) {
    messages::OperatorCommand value = wire::from_message(command);
    value.time = clock.mission_time_of(value.time);
    value.expiry = clock.mission_time_of(value.expiry);
    sink.take(index(), value);
  } else {
    ++report_.malformed;
    return;
  }
  ++report_.received;
}

template <class Message>
bool LcmPort::send(std::string_view channel, const Message& message) {
  const bool sent = endpoint_.publish(channel, wire::Encoded(message).bytes()) == Status::kOk;
  if (!sent) ++report_.unsent;
  return sent;
}

std::uint64_t LcmPort::publish(Time now, const runtime::Outputs& outputs) {
  std::uint64_t setpoints = 0;
  if (has(host::Role::kAutopilot) && outputs.setpoint) {
    if (send(wire::kSetpointChannel, wire::to_message(*outputs.setpoint, now))) ++setpoints;
  }
  if (has(host::Role::kOperator)) {
    for (const messages::CommandAcknowledgement& acknowledgement : outputs.acknowledgements) {
      if (acknowledgement.port == index()) (void)send(wire::kAcknowledgementChannel, wire::to_message(acknowledgement));
    }
  }
  if (has(host::Role::kStatus)) {
    if (outputs.decision) (void)send(wire::kDecisionChannel, wire::to_message(*outputs.decision));
    (void)send(wire::kHealthChannel, wire::to_message(outputs.health, now));
  }
  return setpoints;
}

void LcmPort::publish_detection(const messages::SoundDetection& detection) {
  if (has(host::Role::kStatus)) (void)send(wire::kDetectionChannel, wire::to_message(detection));
}

messages::PortReport LcmPort::report() const {
  messages::PortReport report = report_;
  const host::LcmCounters lcm = endpoint_.counters();
  report.link_up = endpoint_.is_up();
  report.lost += lcm.lost_by_kernel + lcm.overwritten + lcm.datagrams.incomplete;
  report.malformed += lcm.datagrams.malformed + lcm.datagrams.too_large;
  return report;
}

std::string LcmPort::remark() const {
  const host::LcmCounters lcm = endpoint_.counters();
  std::string text;
  const auto add = [&text](std::uint64_t count, const std::string& what) {
    if (count > 0) text += (text.empty() ? "" : "; ") + std::to_string(count) + what;
  };
  add(lcm.lost_by_kernel,
      " datagrams lost on their way in, because they came faster than they were read and the socket's buffer was full: send less often, or "
      "raise sysctl net.core.rmem_max");
  add(lcm.overwritten, " messages lost on their way in, pushed out by newer ones because more than " +
                           std::to_string(config::kLcmQueueDepth) + " of one channel came at once: send them less often, or evenly");
  add(lcm.datagrams.incomplete,
      " messages lost on their way in, because one of their datagrams never came: send messages of less than 64 kB, or mend the network");
  add(report_.unsent,
      " messages could not be sent, because their link was down or its buffer full: look at the interface's errors (ip -s link)");
  add(lcm.interfaces_unheard, " interfaces or addresses are not heard: it listens on " + endpoint_.interfaces());
  return text.empty() ? text : label() + ": " + text;
}

}  // namespace earshot::board
