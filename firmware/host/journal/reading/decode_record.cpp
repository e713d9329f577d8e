#include "firmware/host/journal/reading/decode_record.hpp"

#include <algorithm>
#include <array>

#include "firmware/core/crc32.hpp"
#include "firmware/wire/journal/closing_record.hpp"
#include "firmware/wire/journal/input_record.hpp"
#include "firmware/wire/lcm/channels.hpp"
#include "firmware/wire/lcm/codec.hpp"

namespace earshot::journal {
namespace {

constexpr Unreadable kOfAnotherVersion{.is_known_channel = true};

template <class Message>
Content message_in(std::span<const std::uint8_t> data) {
  Message message;
  if (wire::decode(data, message) != Status::kOk) return kOfAnotherVersion;
  return message;
}

Content closing_in(std::span<const std::uint8_t> data) {
  messages::ClosingRecord closing;
  if (wire::read_closing_record(data, closing) != Status::kOk) return kOfAnotherVersion;
  return closing;
}

}  // namespace

std::string journalled_channel(std::string_view channel) {
  using namespace wire;
  constexpr std::array kInputs{kNavStateChannel,      kSnrEstimateChannel,     kBearingChannel,         kOperatorCommandChannel,
                               kVehicleStatusChannel, kAutopilotStatusChannel, kHydrophoneStatusChannel};
  if (channel == kSetpointChannel) return std::string(kJournalledSetpointChannel);
  return std::ranges::find(kInputs, channel) != kInputs.end() ? std::string(channel) + ".1" : std::string(channel);
}

Content decode_record(std::string_view channel, Time time, std::span<const std::uint8_t> data) {
  messages::Input input;
  const Status as_input = wire::read_input(channel, time, data, 0, input);
  if (as_input == Status::kOk) return input;
  if (as_input != Status::kUnsupported) return kOfAnotherVersion;
  if (channel == wire::kHealthChannel) return message_in<messages::Health>(data);
  if (channel == wire::kJournalledSetpointChannel) return message_in<messages::Setpoint>(data);
  if (channel == wire::kDecisionChannel) return message_in<messages::Decision>(data);
  if (channel == wire::kSafetyEventChannel) return message_in<messages::SafetyEvent>(data);
  if (channel == wire::kAcknowledgementChannel) return message_in<messages::CommandAcknowledgement>(data);
  if (channel == wire::kMissionChannel) return message_in<messages::MissionRecord>(data);
  if (channel == wire::kPolicyChannel) return PolicyBytes{.bytes = {data.begin(), data.end()}, .crc32 = crc32(data)};
  if (channel == wire::kTablesChannel) return TablesBytes{.bytes = {data.begin(), data.end()}, .crc32 = crc32(data)};
  if (channel == wire::kJournalEndChannel) return closing_in(data);
  if (channel == wire::kJournalResumedChannel) return message_in<messages::JournalResumed>(data);
  if (channel == wire::kControllerTroubleChannel) return message_in<messages::ControllerTrouble>(data);
  // A vehicle's journal has none of these; what somebody logged of its bus has.
  if (channel == wire::kDetectionChannel) return message_in<messages::SoundDetection>(data);
  if (channel == wire::kChallengeChannel) return message_in<messages::PublishedChallenge>(data);
  return Unreadable{};
}

}  // namespace earshot::journal
