#include "hil/bus/recorders/pcan_trace.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "firmware/host/text/utc.hpp"
#include "hil/bus/candump/log_fields.hpp"
#include "hil/bus/recorders/recorded_frame.hpp"

namespace earshot::hil {

namespace {

constexpr std::int64_t kDaysUntil1970 = 25'569;  ///< since 1899-12-30
constexpr std::int64_t kSecondsOfADay = 86'400;
constexpr std::int64_t kMicroseconds = 1'000'000;

/// In 1.x the type is Rx, Tx or what is no frame; in 2.x a pair of letters, and the direction is another column.
constexpr std::array<std::pair<std::string_view, std::string_view>, 6> kColumnsOfVersion{{
    {"1.0", "NOILD"},
    {"1.1", "NOTILD"},
    {"1.2", "NOBTILD"},
    {"1.3", "NOBTIRLD"},
    {"2.0", "NOTIdlD"},
    {"2.1", "NOTBIdRLD"},
}};

}  // namespace

void PcanTraceReader::read_header(std::string_view line) {
  const std::string_view name = take_field(line, '=');
  if (name == ";$FILEVERSION") {
    const std::string_view version = take_word(line);
    for (const auto& [known, columns] : kColumnsOfVersion) {
      if (known == version) columns_ = columns;
    }
  } else if (name == ";$COLUMNS") {
    columns_.clear();
    while (!line.empty()) columns_ += take_field(line, ',').substr(0, 1);
  } else if (name == ";$STARTTIME") {
    std::string_view part = take_word(line);
    const auto days = number<std::int64_t>(take_field(part, '.'));
    const auto fraction = scaled("0." + std::string(part), 12);
    has_begin_ = days && fraction && *days > kDaysUntil1970 && *days < 1'000'000;
    if (!has_begin_) return;
    begin_days_ = *days - kDaysUntil1970;
    begin_us_ = (*fraction * (kSecondsOfADay / 100) + 5'000) / 10'000;
  } else if (name.find("python-can") != std::string_view::npos) {
    is_utc_ = true;
  }
}

std::optional<Time> PcanTraceReader::time_of(std::string_view milliseconds) const {
  const auto offset_us = scaled(milliseconds, 3);
  if (!offset_us || !has_begin_) return offset_us ? std::optional(Time{*offset_us}) : std::nullopt;
  const std::int64_t seconds = begin_days_ * kSecondsOfADay + begin_us_ / kMicroseconds;
  std::optional<Time> begin = Time{seconds * kMicroseconds};
  if (!is_utc_) {
    const host::CivilTime date = host::civil_time(*begin);
    begin = local_time({date.year, static_cast<int>(date.month), static_cast<int>(date.day), static_cast<int>(date.hour),
                        static_cast<int>(date.minute), static_cast<int>(date.second)});
  }
  return begin ? std::optional(Time{begin->us + begin_us_ % kMicroseconds + *offset_us}) : std::nullopt;
}

LineOr PcanTraceReader::read(std::string_view line) {
  if (knows(line)) {
    read_header(line);
    return Remark{};
  }
  RecordedFrame frame;
  std::string_view type = "DT";
  std::string_view bus = "1";
  for (const char column : columns_) {
    if (column == 'D') {
      frame.data = line;
      break;
    }
    const std::string_view word = take_word(line);
    if (column == 'N' && !scaled(word.substr(0, word.find(')')), 0)) return "no number of a message";
    if (column == 'O') frame.time = time_of(word);
    if (column == 'T') type = word;
    if (column == 'B') bus = word;
    if (column == 'I') frame.identifier = word;
    if (column == 'L' || column == 'l') frame.size = word;
  }
  if (!frame.time) return "the stamp is no number of milliseconds";
  if (frame.identifier == "FFFFFFFF" || type == "Warng" || type == "ST" || type == "EC" || type == "EV") return Remark{};
  const auto bus_number = number<unsigned>(bus);
  if (!bus_number || *bus_number > 255) return "no number of a bus";
  frame.bus = std::max(*bus_number, 1U) - 1;
  constexpr std::array<std::string_view, 6> kOthers{"RR", "FD", "FB", "FE", "BI", "ER"};
  if (std::ranges::find(kOthers, type) != kOthers.end() || type == "Error" || frame.data.starts_with("RTR"))
    return other_frame(frame.time, frame.bus);
  if (type != "DT" && type != "Rx" && type != "Tx") return "a type of a message that none has";
  frame.is_extended = frame.identifier.size() > 4;
  return entry_of(frame);
}

}  // namespace earshot::hil
