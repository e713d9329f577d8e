#include "hil/bus/serial/slcan_line.hpp"

#include <charconv>
#include <cstddef>
#include <cstdint>

namespace earshot::hil {
namespace {

constexpr char kEnd = '\r';
constexpr char kFrame = 'T';  ///< 29 bits of identifier, and data
constexpr std::size_t kIdentifierDigits = 8;
constexpr std::size_t kMostData = 8;
constexpr std::uint32_t kMostIdentifier = 0x1FFFFFFF;

void append_hexadecimal(std::string& text, std::uint32_t value, std::size_t digits) {
  for (std::size_t i = digits; i-- > 0;) text += "0123456789ABCDEF"[value >> (4 * i) & 0xFU];
}

/// Of all of `text`.
std::optional<std::uint32_t> hexadecimal(std::string_view text) {
  std::uint32_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value, 16);
  return error == std::errc{} && end == text.data() + text.size() ? std::optional(value) : std::nullopt;
}

}  // namespace

std::string to_line(const n2k::Frame& frame) {
  std::string line{kFrame};
  append_hexadecimal(line, frame.identifier, kIdentifierDigits);
  append_hexadecimal(line, frame.size, 1);
  for (const std::uint8_t byte : frame.bytes()) append_hexadecimal(line, byte, 2);
  return line + kEnd;
}

std::string to_line(n2k::ControllerState state) {
  switch (state) {
    case n2k::ControllerState::kErrorActive:
      break;
    case n2k::ControllerState::kErrorPassive:
      return std::string("sp128000") + kEnd;
    case n2k::ControllerState::kBusOff:
      return std::string("sb000256") + kEnd;
  }
  return std::string("sa000000") + kEnd;
}

std::optional<n2k::Frame> read_line(std::string_view line) {
  constexpr std::size_t kHead = 1 + kIdentifierDigits + 1;
  if (line.size() < kHead || line.front() != kFrame) return std::nullopt;
  const auto identifier = hexadecimal(line.substr(1, kIdentifierDigits));
  const auto size = hexadecimal(line.substr(kHead - 1, 1));
  if (!identifier || *identifier > kMostIdentifier || !size || *size > kMostData || line.size() != kHead + 2 * *size) return std::nullopt;
  n2k::Frame frame{.identifier = *identifier, .size = static_cast<std::uint8_t>(*size), .data = {}};
  for (std::size_t i = 0; i < *size; ++i) {
    const auto byte = hexadecimal(line.substr(kHead + 2 * i, 2));
    if (!byte) return std::nullopt;
    frame.data.at(i) = static_cast<std::uint8_t>(*byte);
  }
  return frame;
}

}  // namespace earshot::hil
