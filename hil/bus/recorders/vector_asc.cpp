#include "hil/bus/recorders/vector_asc.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <string>
#include <vector>

#include "hil/bus/candump/log_fields.hpp"
#include "hil/bus/recorders/recorded_frame.hpp"

namespace earshot::hil {

namespace {

constexpr std::uint32_t kRemoteFlag = 0x10;
constexpr std::uint32_t kFlexibleFlag = 0x1000;  ///< CAN FD

std::string lower(std::string_view text) {
  std::string result(text);
  std::ranges::transform(result, result.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return result;
}

/// English and German, as the tools of a German maker write them; 0: none.
int month(std::string_view word) {
  constexpr std::array<std::string_view, 16> kNames{"jan", "feb", "mar", "apr", "may", "jun",        "jul", "aug",
                                                    "sep", "oct", "nov", "dec", "mai", "m\xC3\xA4r", "okt", "dez"};
  constexpr std::array<int, 16> kMonths{1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 5, 3, 10, 12};
  const auto found = std::ranges::find(kNames, lower(word));
  return found == kNames.end() ? 0 : kMonths.at(static_cast<std::size_t>(found - kNames.begin()));
}

/// "Tue Nov 14 10:13:20.123 pm 2023", without the part of a second that follows the point.
std::optional<DateParts> date_of(std::vector<std::string_view> words) {
  const bool has_half = words.size() == 6;
  if (words.size() != 5 && !has_half) return std::nullopt;
  const auto parts = date_parts(words[3].substr(0, words[3].find('.')), "00:00:00");
  const auto day = number<int>(words[2]);
  const auto year = number<int>(words.back());
  if (!parts || !day || !year || month(words[1]) == 0) return std::nullopt;
  int hour = (*parts)[0];
  if (has_half) {
    const std::string half = lower(words[4]);
    if ((half != "am" && half != "pm") || hour < 1 || hour > 12) return std::nullopt;
    hour = hour % 12 + (half == "pm" ? 12 : 0);
  }
  return DateParts{*year, month(words[1]), *day, hour, (*parts)[1], (*parts)[2]};
}

bool is_extended(std::string_view& identifier) {
  if (!identifier.ends_with('x') && !identifier.ends_with('X')) return false;
  identifier.remove_suffix(1);
  return true;
}

/// What stands behind "CANFD": newer tools write classic frames so, too.
LineOr read_flexible(Time time, std::string_view line) {
  const auto channel = number<unsigned>(take_word(line));
  if (!channel || *channel > 255) return "no number of a channel";
  const std::string_view direction = take_word(line);
  RecordedFrame frame{.time = time, .bus = std::max(*channel, 1U) - 1, .identifier = take_word(line), .size = {}, .data = {}};
  if (frame.identifier == "ErrorFrame" || direction == "ErrorFrame") return other_frame(time, frame.bus);
  frame.is_extended = is_extended(frame.identifier);
  std::string_view word = take_word(line);
  // A name of the message may stand here.
  if (word != "0" && word != "1") word = take_word(line);
  const std::string_view error_state = take_word(line);
  (void)take_word(line);  // the length code
  const auto size = number<unsigned>(take_word(line));
  if (direction == "TxRq") return Remark{};
  if ((direction != "Rx" && direction != "Tx") || (word != "0" && word != "1") || error_state.size() != 1 || !size || *size > 64)
    return "no frame of CAN FD";
  frame.data = line;
  for (unsigned i = 0; i < *size + 2; ++i) (void)take_word(line);
  const auto flags = number<std::uint32_t>(take_word(line), 16);
  if (!flags) return "no flags behind the bytes";
  if ((*flags & (kFlexibleFlag | kRemoteFlag)) != 0 || *size > 8) return other_frame(time, frame.bus);
  const std::string digits = std::to_string(*size);
  frame.size = digits;
  return entry_of(frame);
}

}  // namespace

bool VectorAscReader::knows(std::string_view line) {
  const std::string first = lower(line.substr(0, 9));
  return first.starts_with("date ") || first == "base hex " || first == "base hex" || first == "base dec " || first == "base dec";
}

LineOr VectorAscReader::read_date(std::string_view date) {
  std::vector<std::string_view> words;
  while (!date.empty()) words.push_back(take_word(date));
  const auto parts = date_of(words);
  const auto begin = parts ? local_time(*parts) : std::nullopt;
  if (!begin) return "a date that is not read; times count from the beginning of the log";
  const std::size_t point = words[3].find('.');
  const auto part = point == std::string_view::npos ? 0 : scaled("0" + std::string(words[3].substr(point)), 6);
  begin_us_ = begin->us + part.value_or(0);
  return Remark{};
}

void VectorAscReader::read_base(std::string_view line) {
  base_ = take_word(line) == "dec" ? 10 : 16;
  is_relative_ = line.find("relative") != std::string_view::npos;
}

std::optional<Time> VectorAscReader::time_of(std::string_view seconds) {
  const auto stamp_us = scaled(seconds, 6);
  if (!stamp_us || seconds.find('.') == std::string_view::npos) return std::nullopt;
  last_us_ = *stamp_us + (is_relative_ ? last_us_ : 0);
  return Time{begin_us_ + last_us_};
}

LineOr VectorAscReader::read(std::string_view line) {
  std::string_view rest = line;
  const std::string_view first = take_word(rest);
  const std::string word = lower(first);
  if (word == "date") return read_date(rest);
  if (word == "base") {
    read_base(rest);
    return Remark{};
  }
  if (word == "begin" && lower(rest).starts_with("triggerblock ")) {
    (void)take_word(rest);
    return read_date(rest);
  }
  if (first.starts_with("//") || word == "begin" || word == "end" || word == "internal" || word == "no") return Remark{};
  const auto time = time_of(first);
  if (!time) return "the stamp is no number of seconds";
  return read_event(*time, rest);
}

LineOr VectorAscReader::read_event(Time time, std::string_view line) const {
  const std::string_view word = take_word(line);
  if (word == "CANFD") return read_flexible(time, line);
  const auto channel = number<unsigned>(word);
  if (!channel) return word.empty() ? LineOr("no frame") : LineOr(Remark{});
  if (*channel > 255) return "no number of a channel";
  return read_classic(time, std::max(*channel, 1U) - 1, line);
}

LineOr VectorAscReader::read_classic(Time time, unsigned bus, std::string_view line) const {
  RecordedFrame frame{.time = time, .bus = bus, .identifier = take_word(line), .size = {}, .data = {}, .base = base_};
  if (frame.identifier == "ErrorFrame") return other_frame(time, bus);
  // Such as "Statistic:" and the messages that tools put together of frames.
  if (frame.identifier.ends_with(':') || frame.identifier.starts_with("J1939")) return Remark{};
  const std::string_view direction = take_word(line);
  if (direction == "TxRq") return Remark{};
  if (direction != "Rx" && direction != "Tx") return "Rx or Tx follows the identifier";
  const std::string_view kind = take_word(line);
  if (kind == "r") return other_frame(time, bus);
  if (kind != "d") return "d or r follows the direction";
  frame.is_extended = is_extended(frame.identifier);
  frame.size = take_word(line);
  frame.data = line;
  return entry_of(frame);
}

}  // namespace earshot::hil
