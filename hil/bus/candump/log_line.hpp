#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <variant>

#include "firmware/core/time.hpp"
#include "firmware/wire/n2k/frame.hpp"

namespace earshot::hil {

/// What one line of candump says.
struct LogEntry {
  std::optional<Time> time;  ///< the line's stamp: UTC, or relative with -t d and -t z; none where the line has none
  std::string interface;
  std::optional<n2k::Frame> frame;  ///< none: a frame that NMEA 2000 has no use for (11-bit, remote, error, CAN FD)
  friend bool operator==(const LogEntry&, const LogEntry&) = default;
};

/// What a line is: an entry, or why it is none (in words, the end of a complaint).
using LineOr = std::variant<LogEntry, std::string_view>;

/// Reads a line of a log (candump -l, -L) or of the screen (candump; -a, -x and every -t too; not -c, -i, -S).
///
///   (1436509052.249713) can0 09F8017F#50C3B81347D82BC6
///    (1436509052.249713)  can0  RX - -  09F8017F   [8]  50 C3 B8 13 47 D8 2B C6   'P...G.+.'
///
/// A date (-t A) is local time, of this machine's zone.
/// @param line  without its end; any bytes
/// Source: can-utils 2020.11, lib.c, sprint_canframe(), sprint_long_canframe().   Oracle: LogLine tests on what candump printed
[[nodiscard]] LineOr read_line(std::string_view line);

/// The line of a log that canplayer, log2asc and candump's other readers take, with its end. Without a time: that of zero.
[[nodiscard]] std::string log_line(Time time, std::string_view interface, const n2k::Frame& frame);

}  // namespace earshot::hil
