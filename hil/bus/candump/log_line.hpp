#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "firmware/core/time.hpp"
#include "firmware/wire/n2k/frame.hpp"
#include "firmware/wire/n2k/identifier.hpp"

namespace earshot::hil {

/// A message that its recorder put together.
struct WholeMessage {
  n2k::Identifier identifier;
  std::vector<std::uint8_t> bytes;
  friend bool operator==(const WholeMessage&, const WholeMessage&) = default;
};

/// What one line of a log says.
struct LogEntry {
  std::optional<Time> time;  ///< the line's stamp: UTC, or relative with -t d and -t z; none where the line has none
  std::string interface;
  std::optional<n2k::Frame> frame;  ///< neither this nor a message: a frame that NMEA 2000 has no use for (11-bit, remote, error, CAN FD)
  std::optional<WholeMessage> message{};
  friend bool operator==(const LogEntry&, const LogEntry&) = default;
};

/// The interface of a recorder that names none.
inline constexpr std::string_view kUnnamedInterface = "can0";

/// A line that holds no frame: a comment, a header, what candump explains of an error frame.
struct Remark {
  std::uint64_t lost_frames = 0;  ///< that the recorder says it lost here
  friend bool operator==(const Remark&, const Remark&) = default;
};

/// What a line is: an entry, a remark, or why it is neither (in words, the end of a complaint).
using LineOr = std::variant<LogEntry, Remark, std::string_view>;

/// Reads a line of a log (candump -l, -L) or of the screen (candump; -a, -e, -x and every -t too; not -c, -i, -S).
///
///   (1436509052.249713) can0 09F8017F#50C3B81347D82BC6
///    (1436509052.249713)  can0  RX - -  09F8017F   [8]  50 C3 B8 13 47 D8 2B C6   'P...G.+.'
///   <0x09f8017f> [8] 50 c3 b8 13 47 d8 2b c6
///
/// A date (-t A) is local time, of this machine's zone.
/// @param line  without its end; any bytes
/// Source: can-utils 2020.11, lib.c, sprint_canframe(), sprint_long_canframe().   Oracle: LogLine tests on what candump printed
[[nodiscard]] LineOr read_line(std::string_view line);

/// The line of a log that canplayer, log2asc and candump's other readers take, with its end. Without a time: that of zero.
[[nodiscard]] std::string log_line(Time time, std::string_view interface, const n2k::Frame& frame);

}  // namespace earshot::hil
