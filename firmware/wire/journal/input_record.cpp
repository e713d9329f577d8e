#include "firmware/wire/journal/input_record.hpp"

#include <algorithm>
#include <variant>

#include "firmware/config/capacities.hpp"
#include "firmware/wire/lcm/channels.hpp"
#include "firmware/wire/lcm/conversion.hpp"

namespace earshot::wire {
namespace {

using messages::Input;

Encoded encode(const Input& input) {
  return std::visit([](const auto& value) { return Encoded(to_message(value)); }, input.value);
}

/// By the kind of value; the channel of its kind on the bus.
constexpr std::string_view channel_of(const messages::Navigation&) {
  return kNavStateChannel;
}
constexpr std::string_view channel_of(const messages::SnrMeasurement&) {
  return kSnrEstimateChannel;
}
constexpr std::string_view channel_of(const messages::BearingMeasurement&) {
  return kBearingChannel;
}
constexpr std::string_view channel_of(const messages::OperatorCommand&) {
  return kOperatorCommandChannel;
}
constexpr std::string_view channel_of(const messages::PortReport&) {
  return kPortReportChannel;
}
constexpr std::string_view channel_of(const messages::VehicleStatus&) {
  return kVehicleStatusChannel;
}
constexpr std::string_view channel_of(const messages::AutopilotStatus&) {
  return kAutopilotStatusChannel;
}
constexpr std::string_view channel_of(const messages::HydrophoneStatus&) {
  return kHydrophoneStatusChannel;
}

template <class Message>
Status read(std::span<const std::uint8_t> data, Input& input) {
  Message message{};
  if (const Status status = decode(data, message); status != Status::kOk) return status;
  input.value = from_message(message);
  return Status::kOk;
}

}  // namespace

InputRecord::InputRecord(const Input& input) : encoded_(encode(input)) {
  static_assert(config::kMaxPorts <= 10, "one digit");
  const std::string_view channel = std::visit([](const auto& value) { return channel_of(value); }, input.value);
  const auto end = std::copy(channel.begin(), channel.end(), channel_.begin());
  end[0] = '.';
  end[1] = static_cast<char>('0' + input.port);
  channel_size_ = channel.size() + 2;
}

Status read_input(std::string_view channel, Time time, std::span<const std::uint8_t> data, std::uint64_t sequence, Input& input) {
  if (channel.size() < 2 || channel[channel.size() - 2] != '.') return Status::kUnsupported;
  const int port = channel.back() - '0';
  if (port < 0 || port >= static_cast<int>(config::kMaxPorts)) return Status::kUnsupported;
  input.arrival = time;
  input.port = static_cast<std::uint8_t>(port);
  input.sequence = sequence;
  const std::string_view kind = channel.substr(0, channel.size() - 2);
  if (kind == kNavStateChannel) return read<nav_state_t>(data, input);
  if (kind == kSnrEstimateChannel) return read<snr_estimate_t>(data, input);
  if (kind == kBearingChannel) return read<bearing_t>(data, input);
  if (kind == kOperatorCommandChannel) return read<operator_command_t>(data, input);
  if (kind == kPortReportChannel) return read<port_report_t>(data, input);
  if (kind == kVehicleStatusChannel) return read<vehicle_status_t>(data, input);
  if (kind == kAutopilotStatusChannel) return read<autopilot_status_t>(data, input);
  if (kind == kHydrophoneStatusChannel) return read<hydrophone_status_t>(data, input);
  return Status::kUnsupported;
}

}  // namespace earshot::wire
