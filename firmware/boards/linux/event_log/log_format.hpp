#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "firmware/core/time.hpp"

namespace earshot::board {

/// How weighty a line is, by syslog's numbers (RFC 5424).
enum class Severity : std::uint8_t { kError = 3, kWarning = 4, kNotice = 5, kInfo = 6 };

/// A line of the log.
struct LogEntry {
  Severity severity = Severity::kNotice;
  std::string_view event = "program";       ///< what it is about, one word that does not change: "state", "rule", "link"
  std::optional<Time> time = std::nullopt;  ///< on the mission clock
  std::optional<std::uint8_t> port = std::nullopt;
  std::optional<std::uint8_t> rule = std::nullopt;  ///< as people count, from 1
  std::string_view message;
};

/// For whom lines are written.
enum class LogFormat : std::uint8_t {
  kText,     ///< a person: "earshotd: 2026-11-22 15:04:07 UTC: ABORT, navigation went silent"
  kJournal,  ///< systemd's journal, which takes the severity from "<4>" before the line (sd-daemon(3)) and knows who speaks
  kJson,     ///< a program: {"severity": "warning", "event": "state", "time": "2026-11-22T15:04:07Z", "message": "..."}, an object a line
};

/// "text", "journal", "json"; in this order.
inline constexpr std::string_view kLogFormats[]{"text", "journal", "json"};

/// Text where a person reads; journal where standard error leads to systemd's, as JOURNAL_STREAM says.
[[nodiscard]] LogFormat log_format_of_standard_error();

inline constexpr std::size_t kLogLineBytes = 512;  ///< of a line without its end; longer: its message is cut

/// Into memory of the caller's; allocates nothing.
/// @param into  at least kLogLineBytes
[[nodiscard]] std::string_view formatted(const LogEntry& entry, LogFormat format, std::span<char> into);

/// A line that a program says outside of a flight, "earshotd: warning: ...": an error, a warning or a notice by what it begins with. Empty
/// stays empty.
[[nodiscard]] std::string_view formatted(std::string_view plain_line, LogFormat format, std::span<char> into);

/// "2026-11-22 15:04:07 UTC"; "4711 s" of a simulator's clock, which begins at 0.
[[nodiscard]] std::string_view written(Time time, std::span<char> into);

}  // namespace earshot::board
