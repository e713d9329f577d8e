#include "firmware/boards/linux/journal_view/content.hpp"

#include "earshot/safety_event_t.hpp"
#include "earshot/setpoint_t.hpp"
#include "firmware/core/crc32.hpp"
#include "firmware/wire/journal/input_record.hpp"
#include "firmware/wire/lcm/channels.hpp"
#include "firmware/wire/lcm/conversion.hpp"
#include "firmware/wire/lcm/encoding.hpp"

namespace earshot::journal_view {
namespace {

constexpr Unreadable kOfAnotherVersion{.is_known_channel = true};

template <class Message>
Content message_in(std::span<const std::uint8_t> data) {
  Message message{};
  if (wire::decode(data, message) != Status::kOk) return kOfAnotherVersion;
  return message;
}

template <class Message>
Content value_in(std::span<const std::uint8_t> data) {
  Message message{};
  if (wire::decode(data, message) != Status::kOk) return kOfAnotherVersion;
  return wire::from_message(message);
}

Content closing_in(std::span<const std::uint8_t> data) {
  wire::ClosingRecord closing;
  if (wire::read_closing_record(data, closing) != Status::kOk) return kOfAnotherVersion;
  return closing;
}

}  // namespace

Content content_of(std::string_view channel, Time time, std::span<const std::uint8_t> data) {
  messages::Input input;
  const Status as_input = wire::read_input(channel, time, data, 0, input);
  if (as_input == Status::kOk) return input;
  if (as_input != Status::kUnsupported) return kOfAnotherVersion;
  if (channel == wire::kHealthChannel) return message_in<health_t>(data);
  if (channel == wire::kJournalledSetpointChannel) return value_in<setpoint_t>(data);
  if (channel == wire::kDecisionChannel) return message_in<decision_t>(data);
  if (channel == wire::kSafetyEventChannel) return value_in<safety_event_t>(data);
  if (channel == wire::kAcknowledgementChannel) return message_in<command_acknowledgement_t>(data);
  if (channel == wire::kMissionChannel) return message_in<mission_t>(data);
  if (channel == wire::kPolicyChannel) return PolicyBytes{.size = data.size(), .crc32 = crc32(data)};
  if (channel == wire::kTablesChannel) return TablesBytes{.size = data.size(), .crc32 = crc32(data)};
  if (channel == wire::kJournalEndChannel) return closing_in(data);
  if (channel == wire::kJournalResumedChannel) return message_in<journal_resumed_t>(data);
  if (channel == wire::kControllerTroubleChannel) return message_in<controller_trouble_t>(data);
  return Unreadable{};
}

}  // namespace earshot::journal_view
