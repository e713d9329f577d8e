#include "hil/bench/lcm/bad_messages.hpp"

#include <algorithm>
#include <limits>
#include <type_traits>
#include <utility>

#include "firmware/wire/lcm/channels.hpp"
#include "firmware/wire/lcm/encoding.hpp"
#include "firmware/wire/lcm/lc02.hpp"

namespace earshot::hil {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// What a message has in place of every number that may have a fraction.
template <class Message>
void lose_numbers(Message& message) {
  messages::for_each_line_type<Message>([&message]<class Line>() {
    if constexpr (requires { typename Line::Number; }) {
      if constexpr (std::is_same_v<typename Line::Number, double>) *Line::value_in(message) = messages::made_of<typename Line::Value>(kNaN);
    }
  });
}

/// Its sender's.
template <class Message>
Time& date_in(Message& message, Time& sent) {
  if constexpr (requires { message.time; }) {
    return message.time;
  } else {
    return sent;
  }
}

/// @param change  takes references to the message, of its channel's type, and to when it was sent
template <class Type, class Change>
void change_as(LcmMessage& message, Change change) {
  Type value;
  Time sent;
  if (wire::decode(message.data, value, &sent) != Status::kOk) return;
  change(value, sent);
  const wire::Encoded encoded(value, sent);
  message.data.assign(encoded.bytes().begin(), encoded.bytes().end());
}

template <class Change>
void change(LcmMessage& message, Change how) {
  if (message.channel == wire::kNavStateChannel) change_as<messages::Navigation>(message, how);
  if (message.channel == wire::kSnrEstimateChannel) change_as<messages::SnrMeasurement>(message, how);
  if (message.channel == wire::kVehicleStatusChannel) change_as<messages::VehicleStatus>(message, how);
  if (message.channel == wire::kAutopilotStatusChannel) change_as<messages::AutopilotStatus>(message, how);
  if (message.channel == wire::kHydrophoneStatusChannel) change_as<messages::HydrophoneStatus>(message, how);
  if (message.channel == wire::kSetpointChannel) change_as<messages::Setpoint>(message, how);
}

}  // namespace

std::string_view sender_on(std::string_view channel) {
  if (channel == wire::kNavStateChannel) return "navigation";
  if (channel == wire::kSnrEstimateChannel || channel == wire::kHydrophoneStatusChannel) return "hydrophone";
  if (channel == wire::kVehicleStatusChannel) return "vehicle-status";
  if (channel == wire::kAutopilotStatusChannel) return "autopilot";
  for (const std::string_view own :
       {wire::kSetpointChannel, wire::kDecisionChannel, wire::kHealthChannel, wire::kAcknowledgementChannel, wire::kSafetyEventChannel}) {
    if (channel == own) return kEarshotsFrames;
  }
  return "";
}

std::vector<Datagram> BadMessages::pass(const LcmMessages& messages, const std::vector<MessageAffliction>& afflictions, Time now) {
  std::vector<Datagram> arriving;
  std::vector<std::size_t> shuffled;
  const auto is_due = [now](const Late& late) { return late.due <= now; };
  std::ranges::stable_sort(late_, {}, &Late::due);
  for (const Late& late : late_) {
    if (!is_due(late)) continue;
    if (late.is_shuffled) shuffled.push_back(arriving.size());
    arriving.push_back(late.datagram);
  }
  std::erase_if(late_, is_due);
  for (const LcmMessage& message : messages) {
    Fate fate{.message = message, .late = {}, .replays = {}};
    for (const MessageAffliction& affliction : afflictions) {
      if (hits(affliction, message)) inject(affliction, fate);
    }
    if (fate.times == 0) continue;
    const Datagram datagram = datagram_of(fate);
    for (const Duration later : fate.replays) late_.push_back({.due = now + later, .datagram = datagram});
    for (int i = 0; i < fate.times; ++i) {
      if (fate.late > Duration{}) {
        late_.push_back({.due = now + fate.late, .datagram = datagram, .is_shuffled = fate.is_shuffled});
        continue;
      }
      if (fate.is_shuffled) shuffled.push_back(arriving.size());
      arriving.push_back(datagram);
    }
  }
  shuffle(arriving, shuffled);
  return arriving;
}

void BadMessages::inject(const MessageAffliction& affliction, Fate& fate) {
  ++afflicted_;
  switch (affliction.fault) {
    case FrameFault::kLoss:
      fate.times = 0;
      break;
    case FrameFault::kDelay:
      fate.late = fate.late + affliction.seconds;
      break;
    case FrameFault::kJitter:
      fate.late = fate.late + Duration{static_cast<std::int64_t>(random_.uniform_double() * static_cast<double>(affliction.seconds.us))};
      break;
    case FrameFault::kDuplication:
      if (fate.times > 0) ++fate.times;  // what is lost stays lost
      break;
    case FrameFault::kCorruption:
      fate.is_flipped = true;
      break;
    case FrameFault::kNotAvailable:
      change(fate.message, [](auto& value, Time& /*sent*/) { lose_numbers(value); });
      break;
    case FrameFault::kTruncation:
      fate.is_cut = true;
      break;
    case FrameFault::kWrongLength:
      break;
    case FrameFault::kReplay:
      fate.replays.push_back(affliction.seconds);
      break;
    case FrameFault::kReordering:
      fate.is_shuffled = true;
      break;
    case FrameFault::kDateError:
      change(fate.message, [&affliction](auto& value, Time& sent) {
        Time& date = date_in(value, sent);
        date = date + affliction.seconds;
      });
      break;
  }
}

Datagram BadMessages::datagram_of(const Fate& fate) {
  wire::Datagram composed;
  const wire::Lc02Message message{fate.message.channel, fate.message.data};
  if (wire::compose(message, sequence_++, 0, composed) != Status::kOk) return {};
  Datagram datagram(composed.head.begin(), composed.head.begin() + static_cast<std::ptrdiff_t>(composed.head_size));
  datagram.insert(datagram.end(), composed.data.begin(), composed.data.end());
  if (fate.is_cut) datagram.resize(datagram.size() / 2);
  if (fate.is_flipped) datagram.at(random_.next() % datagram.size()) ^= static_cast<std::uint8_t>(1U << random_.next() % 8U);
  return datagram;
}

/// Those at these places change places with each other (Fisher and Yates).
void BadMessages::shuffle(std::vector<Datagram>& arriving, const std::vector<std::size_t>& places) {
  for (std::size_t i = places.size(); i > 1; --i) std::swap(arriving[places[i - 1]], arriving[places[random_.next() % i]]);
}

bool BadMessages::hits(const MessageAffliction& which, const LcmMessage& message) {
  if (!which.sender.empty() && sender_on(message.channel) != which.sender) return false;
  return which.share >= 1.0 || random_.uniform_double() < which.share;
}

}  // namespace earshot::hil
