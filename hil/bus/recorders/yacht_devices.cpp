#include "hil/bus/recorders/yacht_devices.hpp"

#include <string>

#include "hil/bus/candump/log_fields.hpp"

namespace earshot::hil {

namespace {

constexpr std::int64_t kSecond = 1'000'000;
constexpr std::int64_t kDay = 86'400 * kSecond;
constexpr std::string_view kShape = "00:00:00";

std::optional<std::int64_t> time_of_day(std::string_view text) {
  const auto parts = date_parts(text.substr(0, kShape.size()), kShape);
  if (!parts || text.size() < kShape.size() + 2 || text[kShape.size()] != '.') return std::nullopt;
  const auto [hour, minute, second, none3, none4, none5] = *parts;
  const auto part = scaled("0" + std::string(text.substr(kShape.size())), 6);
  if (!part || hour > 23 || minute > 59 || second > 60) return std::nullopt;
  return ((std::int64_t{hour} * 60 + minute) * 60 + second) * kSecond + *part;
}

}  // namespace

bool YachtDevicesReader::knows(std::string_view line) {
  return date_parts(line.substr(0, kShape.size()), kShape).has_value();
}

LineOr YachtDevicesReader::read(std::string_view line) {
  const auto time_us = time_of_day(take_word(line));
  if (!time_us) return "the stamp is no time of day";
  const std::string_view direction = take_word(line);
  if (direction != "R" && direction != "T") return "R or T follows the time";
  const std::string_view digits = take_word(line);
  const auto identifier = digits.size() == 8 ? number<std::uint32_t>(digits, 16) : std::nullopt;
  if (!identifier || *identifier > 0x1FFF'FFFF) return "an identifier has 8 hexadecimal digits, of 29 bits";
  n2k::Frame frame{.identifier = *identifier, .size = 0};
  while (!line.empty()) {
    const auto value = byte(take_word(line));
    if (!value || frame.size == frame.data.size()) return "data are up to 8 bytes of two hexadecimal digits";
    frame.data.at(frame.size++) = *value;
  }
  if (last_us_ && *time_us < *last_us_ - kDay / 2) midnight_us_ += kDay;
  last_us_ = time_us;
  return LogEntry{.time = Time{midnight_us_ + *time_us}, .interface = std::string(kUnnamedInterface), .frame = frame};
}

}  // namespace earshot::hil
