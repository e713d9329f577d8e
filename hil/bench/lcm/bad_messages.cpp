#include "hil/bench/lcm/bad_messages.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <span>
#include <type_traits>
#include <utility>

#include "firmware/messages/dictionary/every_message.hpp"
#include "firmware/wire/lcm/encoding.hpp"
#include "firmware/wire/lcm/lc02.hpp"

namespace earshot::hil {
namespace {

/// The channels of these messages.
template <class... Messages>
constexpr std::array kChannelsOf{messages::Described<Messages>::kChannel...};

struct Sender {
  std::string_view name;
  std::span<const std::string_view> channels;
};

/// Whose messages they are. Nobody on the vehicle has those of the last row: they are an operator's, stand in journals, or go over a
/// board's serial line.
constexpr std::array kSenders{
    Sender{"autopilot", kChannelsOf<messages::AutopilotStatus>},
    Sender{"navigation", kChannelsOf<messages::Navigation>},
    Sender{"hydrophone", kChannelsOf<messages::SnrMeasurement, messages::BearingMeasurement, messages::HydrophoneStatus>},
    Sender{"vehicle-status", kChannelsOf<messages::VehicleStatus>},
    Sender{kEarshotsFrames, kChannelsOf<messages::Setpoint, messages::Decision, messages::SafetyEvent, messages::Health,
                                        messages::CommandAcknowledgement, messages::PublishedChallenge, messages::SoundDetection>},
    Sender{"", kChannelsOf<messages::OperatorCommand, messages::PortReport, messages::UnsentSetpoints, messages::MissionRecord,
                           messages::JournalPart, messages::JournalResumed, messages::ControllerTrouble, messages::ClosingRecord,
                           messages::BoardReport>},
};

constexpr std::ptrdiff_t rows_of(std::string_view channel) {
  return std::ranges::count_if(
      kSenders, [channel](const Sender& sender) { return std::ranges::find(sender.channels, channel) != sender.channels.end(); });
}
template <class... Messages>
constexpr bool has_each_once(messages::Types<Messages...> /*all*/) {
  return ((rows_of(messages::Described<Messages>::kChannel) == 1) && ...);
}
static_assert(has_each_once(messages::EveryMessage{}), "a message of the dictionary stands in no row, or in two");
static_assert(std::ranges::equal(std::span(kSenders).first(kSenders.size() - 1), kLcmSenders, {}, &Sender::name),
              "a case may name these senders, and no others");

/// What a message has in place of every number that may have a fraction.
template <class Message>
void lose_numbers(Message& message) {
  messages::for_each_line_type<Message>([&message]<class Line>() {
    if constexpr (requires { typename Line::Number; }) {
      using Number = typename Line::Number;
      if constexpr (std::is_floating_point_v<Number>) {
        if (auto* const value = Line::value_in(message))
          *value = messages::made_of<typename Line::Value>(std::numeric_limits<Number>::quiet_NaN());
      }
    }
  });
}

/// The first of its times: its own, or its sender's. Null: it has none.
template <class Message>
Time* date_in(Message& message, Time& sent) {
  Time* date = nullptr;
  messages::for_each_line_type<Message>([&]<class Line>() {
    if (date != nullptr) return;
    if constexpr (std::is_same_v<Line, messages::SentTime>) {
      date = &sent;
    } else if constexpr (requires { typename Line::Value; }) {
      if constexpr (std::is_same_v<typename Line::Value, Time>) date = Line::value_in(message);
    }
  });
  return date;
}

/// @param change  takes references to the message, of its channel's type, and to when it was sent
/// @return whether its bytes are others now
template <class Type, class Change>
bool change_as(LcmMessage& message, Change change) {
  Type value;
  Time sent;
  if (wire::decode(message.data, value, &sent) != Status::kOk) return false;
  change(value, sent);
  const wire::Encoded encoded(value, sent);
  if (std::ranges::equal(encoded.bytes(), message.data)) return false;
  message.data.assign(encoded.bytes().begin(), encoded.bytes().end());
  return true;
}

template <class Change, class... Types>
bool change_as_one_of(messages::Types<Types...> /*all*/, LcmMessage& message, Change how) {
  return ((message.channel == messages::Described<Types>::kChannel && change_as<Types>(message, how)) || ...);
}

template <class Change>
bool change(LcmMessage& message, Change how) {
  return change_as_one_of(messages::EveryMessage{}, message, how);
}

}  // namespace

std::string_view sender_on(std::string_view channel) {
  for (const Sender& sender : kSenders) {
    if (std::ranges::find(sender.channels, channel) != sender.channels.end()) return sender.name;
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
    Fate fate{.message = message, .passage = {}, .replays = {}};
    for (const MessageAffliction& affliction : afflictions) {
      if (hits(affliction, message) && inject(affliction, fate)) ++afflicted_;
    }
    if (fate.passage.times == 0) continue;
    const Datagram datagram = datagram_of(fate);
    for (const Duration later : fate.replays) late_.push_back({.due = now + later, .datagram = datagram});
    for (int i = 0; i < fate.passage.times; ++i) {
      if (fate.passage.late > Duration{}) {
        late_.push_back({.due = now + fate.passage.late, .datagram = datagram, .is_shuffled = fate.is_shuffled});
        continue;
      }
      if (fate.is_shuffled) shuffled.push_back(arriving.size());
      arriving.push_back(datagram);
    }
  }
  shuffle(arriving, shuffled);
  return arriving;
}

bool BadMessages::inject(const MessageAffliction& affliction, Fate& fate) {
  if (fate.passage.lose_or_delay(affliction.fault, affliction.seconds, random_)) return true;
  switch (affliction.fault) {
    case Fault::kDuplication:
      if (fate.passage.times == 0) return false;  // what is lost stays lost
      ++fate.passage.times;
      return true;
    case Fault::kCorruption:
      fate.is_flipped = true;
      return true;
    case Fault::kNotAvailable:
      return change(fate.message, [](auto& value, Time& /*sent*/) { lose_numbers(value); });
    case Fault::kTruncation:
      fate.is_cut = true;
      return true;
    case Fault::kReplay:
      fate.replays.push_back(affliction.seconds);
      return true;
    case Fault::kReordering:
      fate.is_shuffled = true;
      return true;
    case Fault::kDateError:
      return change(fate.message, [&affliction](auto& value, Time& sent) {
        if (Time* const date = date_in(value, sent)) *date = *date + affliction.seconds;
      });
    default:
      throw NoMaker(affliction.fault, "of messages over LCM");
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
