#include "hil/bus/recorders/recorded_frame.hpp"

#include <string>

#include "hil/bus/candump/log_fields.hpp"

namespace earshot::hil {

namespace {

constexpr std::uint32_t kHighestExtended = 0x1FFF'FFFF;
constexpr std::uint32_t kHighestStandard = 0x7FF;

}  // namespace

LogEntry other_frame(std::optional<Time> time, unsigned bus) {
  return {.time = time, .interface = "can" + std::to_string(bus), .frame = std::nullopt};
}

LineOr entry_of(const RecordedFrame& recorded) {
  const auto identifier = number<std::uint32_t>(recorded.identifier, recorded.base);
  if (!identifier || *identifier > (recorded.is_extended ? kHighestExtended : kHighestStandard))
    return "an identifier is a number of 11 or 29 bits";
  const auto size = number<unsigned>(recorded.size, 16);
  if (!size || *size > 64) return "no number of bytes";
  LogEntry entry = other_frame(recorded.time, recorded.bus);
  n2k::Frame frame{.identifier = *identifier, .size = 0};
  std::string_view data = recorded.data;
  for (unsigned i = 0; i < *size && i < frame.data.size(); ++i) {
    const auto value = number<std::uint8_t>(take_word(data), recorded.base);
    if (!value) return "there are fewer bytes than it states, or other things";
    frame.data.at(frame.size++) = *value;
  }
  if (recorded.is_extended && *size <= frame.data.size()) entry.frame = frame;
  return entry;
}

}  // namespace earshot::hil
