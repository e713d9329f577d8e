#include "firmware/wire/journal/input_record.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <variant>

#include "firmware/config/capacities.hpp"
#include "firmware/wire/lcm/channels.hpp"

namespace earshot::wire {
namespace {

using messages::Input;
using Value = decltype(Input::value);

template <class... Values>
constexpr std::array<std::string_view, sizeof...(Values)> channels_of(std::variant<Values...>* /*kinds*/) {
  return {channel_of<Values>...};
}

/// In the order of the alternatives of a value.
constexpr auto kChannels = channels_of(static_cast<Value*>(nullptr));

template <std::size_t kKind>
Status read(std::span<const std::uint8_t> data, Value& value) {
  std::variant_alternative_t<kKind, Value> read;
  const Status status = decode(data, read);
  if (status == Status::kOk) value.emplace<kKind>(read);
  return status;
}

/// Without calls through pointers, whose stack no compiler knows.
template <std::size_t kKind = 0>
Status read(std::size_t kind, std::span<const std::uint8_t> data, Value& value) {
  if constexpr (kKind < std::variant_size_v<Value>) {
    return kind == kKind ? read<kKind>(data, value) : read<kKind + 1>(kind, data, value);
  } else {
    return Status::kUnsupported;
  }
}

}  // namespace

InputRecord::InputRecord(const Input& input) : encoded_(std::visit([](const auto& value) { return Encoded(value); }, input.value)) {
  static_assert(config::kMaxPorts <= 10, "one digit");
  const std::string_view channel = kChannels[input.value.index()];
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
  const auto known = static_cast<std::size_t>(std::ranges::find(kChannels, kind) - kChannels.begin());
  return read(known, data, input.value);
}

}  // namespace earshot::wire
