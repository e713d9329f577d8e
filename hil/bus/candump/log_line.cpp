#include "hil/bus/candump/log_line.hpp"

#include <algorithm>
#include <array>

#include "firmware/host/text/numbers.hpp"
#include "firmware/host/transport/interface_name.hpp"
#include "hil/bus/candump/log_fields.hpp"

namespace earshot::hil {

namespace {

constexpr std::size_t kExtendedDigits = 8;
constexpr std::size_t kStandardDigits = 3;
constexpr std::uint32_t kErrorFlag = 0x2000'0000;  ///< candump writes it with the identifier of an error frame
constexpr std::uint32_t kIdentifierBits = 0x1FFF'FFFF;
constexpr std::int64_t kMicroseconds = 1'000'000;

/// "123.000456", as candump writes seconds: six digits behind the point, or nine, of which three are left out.
std::optional<Time> seconds(std::string_view text) {
  const std::size_t point = text.find('.');
  if (point == std::string_view::npos) return std::nullopt;
  const std::size_t digits = text.size() - point - 1;
  if ((digits != 6 && digits != 9) || !number<std::uint32_t>(text.substr(point + 1))) return std::nullopt;
  const auto whole = number<std::uint64_t>(text.substr(0, point));
  const auto part = number<std::uint32_t>(text.substr(point + 1, 6));
  constexpr std::uint64_t kMost = INT64_MAX / kMicroseconds - 1;
  if (!whole || !part || *whole > kMost) return std::nullopt;
  return Time{static_cast<std::int64_t>(*whole) * kMicroseconds + *part};
}

std::optional<Time> stamp(std::string_view text) {
  const std::size_t blank = text.find(' ');
  if (blank == std::string_view::npos) return seconds(text);
  const std::size_t point = std::min(text.find('.'), text.size());
  const auto parts = date_parts(text.substr(0, point), "0000-00-00 00:00:00");
  const auto date = parts ? local_time(*parts) : std::nullopt;
  const auto part = seconds("0" + std::string(text.substr(point)));
  if (!date || !part) return std::nullopt;
  return Time{date->us + part->us};
}

/// The identifier of a frame; nothing for what has none. Of an 11-bit or an error frame `is_ours` becomes false.
std::optional<std::uint32_t> identifier(std::string_view digits, bool& is_ours) {
  const auto value = number<std::uint32_t>(digits, 16);
  if (!value || (digits.size() != kExtendedDigits && digits.size() != kStandardDigits)) return std::nullopt;
  if (digits.size() == kStandardDigits) is_ours = false;
  if (digits.size() == kStandardDigits && *value > 0x7FF) return std::nullopt;
  if ((*value & kErrorFlag) != 0) is_ours = false;
  if (is_ours && *value > kIdentifierBits) return std::nullopt;
  return *value & kIdentifierBits;
}

constexpr std::string_view kNoIdentifier = "an identifier has 3 or 8 hexadecimal digits, of 11 or 29 bits";
constexpr std::string_view kNoData = "data are up to 8 bytes of two hexadecimal digits";

/// What stands behind the identifier of a log: pairs of digits.
std::optional<n2k::Frame> packed_frame(std::uint32_t id, std::string_view digits) {
  n2k::Frame frame{.identifier = id, .size = 0};
  if (digits.size() > 2 * frame.data.size() || digits.size() % 2 != 0) return std::nullopt;
  for (std::size_t i = 0; i < digits.size(); i += 2) {
    const auto value = byte(digits.substr(i, 2));
    if (!value) return std::nullopt;
    frame.data.at(frame.size++) = *value;
  }
  return frame;
}

/// "09F8017F#50C3B81347D82BC6"; behind it may stand the direction, R or T.
LineOr read_packed(LogEntry entry, std::string_view word, std::string_view rest) {
  const std::size_t hash = word.find('#');
  bool is_ours = true;
  const auto id = identifier(word.substr(0, hash), is_ours);
  if (!id) return kNoIdentifier;
  if (!rest.empty() && rest != "R" && rest != "T") return "something stands behind the frame";
  std::string_view data = word.substr(hash + 1);
  if (data.size() == 18 && data[16] == '_') data.remove_suffix(2);  // 8 bytes whose length code says more
  if (data.starts_with('#')) {
    const bool is_hexadecimal = data.find_first_not_of("0123456789ABCDEFabcdef", 1) == std::string_view::npos;
    if (data.size() < 2 || data.size() % 2 != 0 || data.size() > 2 + 2 * 64 || !is_hexadecimal) return kNoData;
    return entry;
  }
  if (data.starts_with('R')) {
    if (data.size() > 2 || (data.size() == 2 && (data[1] < '0' || data[1] > '8'))) return kNoData;
    return entry;
  }
  const auto frame = packed_frame(*id, data);
  if (!frame) return kNoData;
  if (is_ours) entry.frame = frame;
  return entry;
}

/// "[8]" or "[12]": the number of bytes; over 8 it is CAN FD.
std::optional<unsigned> size_in_brackets(std::string_view word) {
  if (word.size() < 3 || word.front() != '[' || word.back() != ']') return std::nullopt;
  const auto size = number<unsigned>(word.substr(1, word.size() - 2));
  return size && *size <= 64 ? size : std::nullopt;
}

/// "09F8017F   [8]  50 C3 B8 13 47 D8 2B C6", and the bytes as characters (-a) behind it.
LineOr read_spread(LogEntry entry, std::string_view word, std::string_view rest) {
  if (word == "RX" || word == "TX") {
    for (int flags = 0; flags < 2; ++flags) {
      const std::string_view flag = take_word(rest);
      if (flag != "-" && flag != "B" && flag != "E") return "RX or TX is followed by two flags";
    }
    word = take_word(rest);
  }
  bool is_ours = true;
  const auto id = identifier(word, is_ours);
  if (!id) return kNoIdentifier;
  const std::string_view brackets = take_word(rest);
  const auto size = size_in_brackets(brackets);
  if (!size) return "no number of bytes in brackets";
  if (rest == "remote request") return entry;
  n2k::Frame frame{.identifier = *id, .size = 0};
  for (unsigned i = 0; i < *size; ++i) {
    const auto value = byte(take_word(rest));
    if (!value) return kNoData;
    if (i < frame.data.size()) frame.data.at(frame.size++) = *value;
  }
  if (!rest.empty() && rest.front() != '\'' && rest != "ERRORFRAME") return "something stands behind the frame";
  const bool is_flexible = brackets.size() != 3;
  if (is_ours && !is_flexible && rest != "ERRORFRAME") entry.frame = frame;
  return entry;
}

/// "DROPCOUNT: dropped 3 CAN frames on 'can0' socket (total drops 3)": that candump lost, by its option -d or -D.
std::optional<Remark> frames_dropped(std::string_view line) {
  if (take_word(line) != "DROPCOUNT:" || take_word(line) != "dropped") return std::nullopt;
  const auto count = number<std::uint64_t>(take_word(line));
  return count ? std::optional(Remark{.lost_frames = *count}) : std::nullopt;
}

/// "controller-problem{rx-overflow}": below an error frame, one line for each of its classes (candump -e).
bool explains_error_frame(std::string_view line) {
  constexpr std::array<std::string_view, 10> kClasses{
      "tx-timeout", "lost-arbitration", "controller-problem",      "protocol-violation", "transceiver-status", "no-acknowledgement-on-tx",
      "bus-off",    "bus-error",        "restarted-after-bus-off", "error-counter-tx-rx"};
  const std::string_view name = line.substr(0, line.find('{'));
  return std::ranges::find(kClasses, name) != kClasses.end() && (name == line || line.ends_with('}'));
}

/// What a line says beside frames.
std::optional<Remark> remark(std::string_view line) {
  // The last is the first line of a candump before can-utils.
  if (line.starts_with('#') || explains_error_frame(line) || line.starts_with("interface = ")) return Remark{};
  return frames_dropped(line);
}

/// "<0x09f8017f> [8] 50 c3 b8 13 47 d8 2b c6", of a candump before can-utils.
LineOr read_in_angles(std::string_view line) {
  const std::string_view word = take_word(line);
  if (!word.ends_with('>')) return kNoIdentifier;
  return read_spread({.time = std::nullopt, .interface = std::string(kUnnamedInterface), .frame = std::nullopt},
                     word.substr(3, word.size() - 4), line);
}

}  // namespace

LineOr read_line(std::string_view line) {
  if (line.ends_with('\r')) line.remove_suffix(1);
  line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
  line = line.substr(0, line.find_last_not_of(" \t") + 1);
  if (const auto found = remark(line)) return *found;
  if (line.starts_with("<0x")) return read_in_angles(line);
  LogEntry entry;
  if (line.starts_with('(')) {
    const std::size_t end = line.find(')');
    entry.time = stamp(line.substr(1, std::min(end, line.size()) - 1));
    if (end == std::string_view::npos || !entry.time) return "the stamp is no time";
    line.remove_prefix(end + 1);
  }
  entry.interface = take_word(line);
  if (!host::is_interface_name(entry.interface)) return "no name of an interface";
  const std::string_view word = take_word(line);
  if (word.empty()) return "no frame";
  return word.find('#') != std::string_view::npos ? read_packed(entry, word, line) : read_spread(entry, word, line);
}

std::string log_line(Time time, std::string_view interface, const n2k::Frame& frame) {
  const std::int64_t us = std::max<std::int64_t>(time.us, 0);
  std::string line =
      host::formatted("(%010lld.%06lld) ", static_cast<long long>(us / kMicroseconds), static_cast<long long>(us % kMicroseconds));
  line += interface;
  constexpr std::string_view kDigits = "0123456789ABCDEF";
  line += ' ';
  for (unsigned shift = 32; shift > 0; shift -= 4) line += kDigits[(frame.identifier >> (shift - 4)) & 0xFU];
  line += '#';
  for (const std::uint8_t value : frame.bytes()) {
    line += kDigits[value >> 4U];
    line += kDigits[value & 0xFU];
  }
  return line += '\n';
}

}  // namespace earshot::hil
