#include "hil/bus/recorders/canboat_plain.hpp"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "firmware/wire/n2k/signals.hpp"
#include "hil/bus/candump/log_fields.hpp"

namespace earshot::hil {

namespace {

/// Numbers of canboat's own, for what an interface says of itself.
constexpr std::uint32_t kBeyondTheBus = 0x40000;
constexpr std::uint32_t kFirstProprietary = 130'816;  ///< of those that come as fast packets
constexpr std::string_view kDate = "0000-00-00";
constexpr std::string_view kTime = "00:00:00";

/// "+05:30": its microseconds; of "Z" and nothing none.
std::optional<std::int64_t> offset_us(std::string_view zone) {
  if (zone.empty() || zone == "Z") return 0;
  const auto parts = date_parts(zone.substr(1), "00:00");
  if (!parts || (zone[0] != '+' && zone[0] != '-')) return std::nullopt;
  const std::int64_t us = (std::int64_t{(*parts)[0]} * 60 + (*parts)[1]) * 60'000'000;
  return zone[0] == '-' ? -us : us;
}

std::optional<Time> stamp(std::string_view text) {
  DateParts parts{1970, 1, 1, 0, 0, 0};
  if (const auto date = date_parts(text.substr(0, kDate.size()), kDate)) {
    std::copy_n(date->begin(), 3, parts.begin());
    text.remove_prefix(kDate.size());
    if (text.empty() || std::string_view("-TZ ").find(text[0]) == std::string_view::npos) return std::nullopt;
    text.remove_prefix(1);
  }
  const auto time = date_parts(text.substr(0, kTime.size()), kTime);
  if (!time) return std::nullopt;
  std::copy_n(time->begin(), 3, parts.begin() + 3);
  text.remove_prefix(kTime.size());
  const std::size_t zone = std::min(text.find_first_of("Z+-"), text.size());
  const auto part = scaled("0" + std::string(text.substr(0, zone)), 6);
  const auto offset = offset_us(text.substr(zone));
  const auto whole = utc_time(parts);
  if (!part || !offset || !whole) return std::nullopt;
  return Time{whole->us + *part - *offset};
}

/// The number that stands next in the line, up to `most`.
std::optional<std::uint32_t> take_number(std::string_view& line, std::uint32_t most) {
  const auto value = number<std::uint32_t>(take_field(line, ','));
  return value && *value <= most ? value : std::nullopt;
}

/// So many bytes. The padding of a message's last frame may stand behind them.
std::optional<std::vector<std::uint8_t>> bytes_of(std::string_view line, std::size_t size) {
  std::vector<std::uint8_t> bytes;
  while (bytes.size() < size) {
    std::string_view field = take_field(line, ',');
    const auto value = number<std::uint8_t>(take_word(field), 16);
    if (!value) return std::nullopt;
    bytes.push_back(*value);
  }
  while (!line.empty()) {
    const std::string_view padding = take_field(line, ',');
    if (padding != "ff" && padding != "FF") return std::nullopt;
  }
  return bytes;
}

/// Whether no message of a group fits a frame. Proprietary groups have other messages than ours.
bool is_always_longer(std::uint32_t pgn) {
  const n2k::Message* const message = n2k::find_message(pgn);
  return message != nullptr && message->size > 8 && pgn != n2k::kPeerPgn && pgn < kFirstProprietary;
}

}  // namespace

bool CanboatReader::knows(std::string_view line) {
  const std::string_view first = take_field(line, ',');
  const bool has_date = date_parts(first.substr(0, kDate.size()), kDate).has_value();
  const bool has_time = date_parts(first.substr(0, kTime.size()), kTime).has_value();
  return has_date || (has_time && !line.empty());
}

void CanboatReader::read_comment(std::string_view line) {
  if (line.find("format=FAST") != std::string_view::npos) lines_ = Lines::kMessages;
  if (line.find("format=PLAIN") != std::string_view::npos) lines_ = Lines::kFrames;
  if (line.find("format=PLAIN_OR_FAST") != std::string_view::npos || line.find("format=PLAIN_MIX_FAST") != std::string_view::npos)
    lines_ = Lines::kAnything;
}

bool CanboatReader::is_message(std::uint32_t pgn, std::size_t bytes) const {
  if (bytes > 8 || lines_ == Lines::kMessages) return true;
  return lines_ == Lines::kFramesAndMessages && !is_always_longer(pgn);
}

LineOr CanboatReader::read(std::string_view line) {
  auto time = stamp(take_field(line, ','));
  if (!time) return "the stamp is no time";
  const auto priority = take_number(line, 7);
  const auto pgn = take_number(line, UINT32_MAX);
  const auto source = take_number(line, 255);
  const auto destination = take_number(line, 255);
  const auto size = take_number(line, kLongest);
  if (!priority || !pgn || !source || !destination || !size)
    return "priority, parameter group, source, destination and size are numbers in this order";
  const auto bytes = bytes_of(line, *size);
  if (!bytes) return "there are fewer or more bytes than it states, or other things";
  if (*pgn >= kBeyondTheBus) return Remark{};
  // A clock that was never set, west of Greenwich.
  if (time->us < 0) time.reset();
  n2k::Identifier identifier{.pgn = *pgn,
                             .priority = static_cast<std::uint8_t>(*priority),
                             .source = static_cast<std::uint8_t>(*source),
                             .destination = static_cast<std::uint8_t>(*destination)};
  // Of a group that has no address canboat's own devices write 0.
  if (((*pgn >> 8U) & 0xFFU) >= 240) identifier.destination = n2k::kBroadcast;
  const auto can_identifier = n2k::compose(identifier);
  if (!can_identifier.ok()) return "a parameter group that none is";
  if (*size > 8 && lines_ == Lines::kAnything) lines_ = Lines::kFramesAndMessages;
  LogEntry entry{.time = time, .interface = std::string(kUnnamedInterface), .frame = std::nullopt};
  if (is_message(*pgn, *size)) {
    entry.message = WholeMessage{.identifier = identifier, .bytes = *bytes};
  } else {
    entry.frame = n2k::Frame{.identifier = can_identifier.value(), .size = static_cast<std::uint8_t>(*size)};
    std::ranges::copy(*bytes, entry.frame->data.begin());
  }
  return entry;
}

}  // namespace earshot::hil
