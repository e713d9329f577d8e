#include "firmware/boards/linux/event_log/log_format.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdlib>
#include <string>

#include "firmware/host/text/text_line.hpp"
#include "firmware/host/text/utc.hpp"

namespace earshot::board {
namespace {

using host::goes_on;
using host::TextInto;

constexpr Time kLongAgo{
    std::chrono::microseconds(std::chrono::sys_days(std::chrono::year(2000) / std::chrono::January / 1).time_since_epoch()).count()};

void write_date(TextInto& to, Time time, std::string_view between, std::string_view zone) {
  const host::CivilTime t = host::civil_time(time);
  to << t.year << "-";
  to.two_digits(t.month) << "-";
  to.two_digits(t.day) << between;
  to.two_digits(t.hour) << ":";
  to.two_digits(t.minute) << ":";
  to.two_digits(t.second) << zone;
}

std::string_view word_of(Severity severity) {
  switch (severity) {
    case Severity::kError:
      return "error";
    case Severity::kWarning:
      return "warning";
    case Severity::kNotice:
      return "notice";
    case Severity::kInfo:
      return "info";
  }
  return "notice";
}

/// As JSON wants it, and no further than leaves room for the end of the object. Bytes that are no ASCII stand in what programs say only
/// where host::printable() has let them pass as UTF-8.
void write_escaped(TextInto& to, std::string_view text, std::size_t room_for_end) {
  constexpr std::string_view kHexadecimal = "0123456789abcdef";
  constexpr std::size_t kLongest = 6;  // also of a character's bytes, of which there are at most 4
  for (const char character : text) {
    if (to.left() < (goes_on(character) ? 1 : kLongest) + room_for_end) return;
    const auto code = static_cast<unsigned char>(character);
    if (character == '"' || character == '\\') {
      to << "\\" << std::string_view(&character, 1);
    } else if (code < 0x20) {
      to << "\\u00" << kHexadecimal.substr(code >> 4U, 1) << kHexadecimal.substr(code & 15U, 1);
    } else {
      to << std::string_view(&character, 1);
    }
  }
}

std::string_view as_json(const LogEntry& entry, TextInto to) {
  constexpr std::string_view kEnd = "\"}";
  to << R"({"severity": ")" << word_of(entry.severity) << R"(", "event": ")" << entry.event << "\"";
  if (entry.time && *entry.time < kLongAgo) {
    to << R"(, "time_s": )" << entry.time->us / 1'000'000;
  } else if (entry.time) {
    to << R"(, "time": ")";
    write_date(to, *entry.time, "T", "Z\"");
  }
  if (entry.port) to << R"(, "port": )" << unsigned{*entry.port};
  if (entry.rule) to << R"(, "rule": )" << unsigned{*entry.rule};
  to << R"(, "message": ")";
  write_escaped(to, entry.message, kEnd.size());
  return (to << kEnd).text();
}

}  // namespace

LogFormat log_format_of_standard_error() {
  const char* const stream = std::getenv("JOURNAL_STREAM");
  struct stat status {};
  if (stream == nullptr || ::fstat(STDERR_FILENO, &status) != 0) return LogFormat::kText;
  const std::string ours = std::to_string(status.st_dev) + ":" + std::to_string(status.st_ino);
  return ours == stream ? LogFormat::kJournal : LogFormat::kText;
}

std::string_view written(Time time, std::span<char> into) {
  TextInto to(into);
  if (time < kLongAgo) return (to << time.us / 1'000'000 << " s").text();
  write_date(to, time, " ", " UTC");
  return to.text();
}

std::string_view formatted(const LogEntry& entry, LogFormat format, std::span<char> into) {
  TextInto to(into.first(std::min(into.size(), kLogLineBytes)));
  if (format == LogFormat::kJson) return as_json(entry, to);
  if (format == LogFormat::kJournal) {
    to << "<" << static_cast<unsigned>(entry.severity) << ">";
  } else {
    to << "earshotd: ";
  }
  if (entry.time) {
    std::array<char, 32> date{};
    to << written(*entry.time, date) << ": ";
  }
  return (to << entry.message).text();
}

std::string_view formatted(std::string_view plain_line, LogFormat format, std::span<char> into) {
  constexpr std::string_view kName = "earshotd: ";
  if (format == LogFormat::kText || plain_line.empty()) return plain_line;
  if (plain_line.starts_with(kName)) plain_line.remove_prefix(kName.size());
  LogEntry entry{.message = plain_line};
  if (plain_line.starts_with("warning: ")) entry.severity = Severity::kWarning;
  if (plain_line.starts_with("error: ")) entry.severity = Severity::kError;
  return formatted(entry, format, into);
}

}  // namespace earshot::board
