#include "firmware/boards/linux/lcm_port.hpp"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

#include "firmware/config/capacities.hpp"
#include "firmware/wire/lcm/channels.hpp"
#include "firmware/wire/lcm/encoding.hpp"
#include "firmware/wire/lcm/order_reader.hpp"

namespace earshot::board {
namespace {

template <class Message, class... Kinds>
constexpr bool kIsOneOf = (std::is_same_v<Message, Kinds> || ...);

/// The role of the ports that bring a kind of input on its channel; nothing of what no port brings by LCM.
template <class Message>
constexpr std::optional<host::Role> brought_as() {
  if constexpr (kIsOneOf<Message, messages::Navigation, messages::VehicleStatus>) {
    return host::Role::kNavigation;
  } else if constexpr (kIsOneOf<Message, messages::SnrMeasurement, messages::BearingMeasurement, messages::HydrophoneStatus>) {
    return host::Role::kSnr;
  } else if constexpr (kIsOneOf<Message, messages::OperatorCommand>) {
    return host::Role::kOperator;
  } else if constexpr (kIsOneOf<Message, messages::AutopilotStatus>) {
    return host::Role::kAutopilot;
  } else {
    static_assert(kIsOneOf<Message, messages::PortReport, messages::UnsentSetpoints>, "which ports bring this kind of input?");
    return std::nullopt;
  }
}

/// Calls `take.template operator()<Message>()` with every kind of input that comes by LCM, until it returns true. @return whether it did
template <class Take>
bool any_input(Take take) {
  const auto any_of = [&take]<class... Messages>(const std::variant<Messages...>* /*types*/) {
    const auto of_one = [&take]<class Message>(const Message* /*type*/) {
      if constexpr (brought_as<Message>().has_value()) return take.template operator()<Message>();
      return false;
    };
    return (of_one(static_cast<const Messages*>(nullptr)) || ...);
  };
  return any_of(static_cast<const InputSink::Value*>(nullptr));
}

std::vector<std::string_view> channels_of(host::Roles roles) {
  std::vector<std::string_view> channels;
  any_input([&]<class Message>() {
    if (roles.has(*brought_as<Message>())) channels.push_back(wire::channel_of<Message>);
    return false;
  });
  return channels;
}

/// However many orders follow it before they are taken.
bool is_abort(std::string_view channel, std::span<const std::uint8_t> data) {
  return channel == wire::kOperatorCommandChannel && wire::read_order(data).command.order == messages::Order::kAbort;
}

template <class Message>
Time& date_in(Message& message) {
  return message.time;
}
Time& date_in(messages::SoundDetection& detection) {
  return detection.begin;
}

}  // namespace

LcmPort::LcmPort(std::uint8_t index, const host::PortSettings& settings, host::IfMissing if_missing)
    : Port(index, settings.roles),
      name_(settings.name),
      address_(settings.address),
      orders_(index, settings.command_proof),
      snr_is_simulators_(settings.snr_is_simulators),
      endpoint_(host::parse_lcm_url(settings.address), channels_of(settings.roles), is_abort, if_missing) {}

void LcmPort::collect(Clock& clock, InputSink& sink) {
  clock_ = &clock;
  endpoint_.collect();
  for (wire::Lc02Message message; endpoint_.take(message) == Status::kOk;) {
    if (snr_is_simulators_ && is_strangers(message)) continue;
    ++(take(clock, message, sink) ? report_.received : report_.malformed);
  }
}

bool LcmPort::is_strangers(const wire::Lc02Message& message) {
  const bool is_snr = message.channel == wire::kSnrEstimateChannel;
  const bool is_bearing = message.channel == wire::kBearingChannel;
  strangers_snr_ += is_snr ? 1 : 0;
  strangers_bearings_ += is_bearing ? 1 : 0;
  return is_snr || is_bearing;
}

/// @return whether it is a whole message of that type
template <class Message>
bool LcmPort::takes(Clock& clock, std::span<const std::uint8_t> data, InputSink& sink) {
  Message value;
  if (wire::decode(data, value) != Status::kOk) return false;
  value.time = clock.mission_time_of(value.time);
  sink.take(index(), value);
  return true;
}

bool LcmPort::take_order(Clock& clock, std::span<const std::uint8_t> data, InputSink& sink) {
  const wire::ReadOrder order = wire::read_order(data);
  messages::OperatorCommand command = order.command;
  if (order.form == wire::OrderForm::kUnreadable) {
    if (const auto answer = orders_.refuse_unreadable(command, clock.now(), sink)) send_dated(wire::kAcknowledgementChannel, *answer);
    return false;
  }
  if (order.form == wire::OrderForm::kAbort) sink.report_order_trouble(index(), OrderTrouble::kCutAbort);
  orders_.judge_mark(command, sink);
  command.time = clock.mission_time_of(command.time);
  command.expiry = clock.mission_time_of(command.expiry);
  sink.take(index(), command);
  return true;
}

bool LcmPort::take(Clock& clock, const wire::Lc02Message& message, InputSink& sink) {
  return any_input([&]<class Message>() {
    if (message.channel != wire::channel_of<Message>) return false;
    if constexpr (std::is_same_v<Message, messages::OperatorCommand>) return take_order(clock, message.data, sink);
    return takes<Message>(clock, message.data, sink);
  });
}

template <class Message>
bool LcmPort::send(std::string_view channel, const Message& message, Time now) {
  const bool sent = endpoint_.publish(channel, wire::Encoded(message, now).bytes()) == Status::kOk;
  if (!sent) ++report_.unsent;
  return sent;
}

/// In place of its own date, which is the mission clock's, it bears the host's.
template <class Message>
void LcmPort::send_dated(std::string_view channel, Message message) {
  Time& own = date_in(message);
  own = date_of(own);
  (void)send(channel, message);
}

std::uint64_t LcmPort::publish(Time now, const runtime::Outputs& outputs) {
  std::uint64_t setpoints = 0;
  orders_.end_turn();
  if (has(host::Role::kAutopilot) && outputs.setpoint) {
    if (send(wire::kSetpointChannel, *outputs.setpoint, date_of(now))) ++setpoints;
  }
  if (has(host::Role::kOperator)) {
    if (orders_.proof()) (void)send(wire::kChallengeChannel, orders_.proof()->published(date_of(now)));
    for (const messages::CommandAcknowledgement& acknowledgement : outputs.acknowledgements) {
      if (acknowledgement.port == index()) send_dated(wire::kAcknowledgementChannel, acknowledgement);
    }
  }
  if (has(host::Role::kStatus)) {
    if (outputs.decision) send_dated(wire::kDecisionChannel, *outputs.decision);
    for (const messages::SafetyEvent& event : outputs.safety_events) send_dated(wire::kSafetyEventChannel, event);
    (void)send(wire::kHealthChannel, outputs.health, date_of(now));
  }
  return setpoints;
}

void LcmPort::publish_detection(const messages::SoundDetection& detection) {
  if (has(host::Role::kStatus)) send_dated(wire::kDetectionChannel, detection);
}

messages::PortReport LcmPort::report() const {
  messages::PortReport report = report_;
  const host::LcmCounters lcm = endpoint_.counters();
  report.link_up = endpoint_.is_up();
  report.lost += lcm.lost_by_kernel + lcm.overwritten + lcm.datagrams.incomplete;
  report.malformed += lcm.datagrams.malformed + lcm.datagrams.too_large;
  return report;
}

PortWords LcmPort::words() const {
  return {.label = label(), .details = "on " + endpoint_.interfaces(), .remark = remark(), .strangers = strangers()};
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
      " messages could not be sent, because their link was down or its buffer full: check the interface's errors (ip -s link)");
  add(lcm.interfaces_unheard, " interfaces or addresses are not heard: it listens on " + endpoint_.interfaces());
  return text.empty() ? text : label() + ": " + text;
}

std::string LcmPort::strangers() const {
  if (strangers_snr_ + strangers_bearings_ == 0) return {};
  return label() + ": " + std::to_string(strangers_snr_) + " SNRs and " + std::to_string(strangers_bearings_) +
         " bearings of somebody else on this bus were ignored: in simulation they come from the simulator alone";
}

}  // namespace earshot::board
