#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "hil/bus/candump/log_line.hpp"

namespace earshot::hil {

/// Reads a trace of PEAK's PCAN-View or PCAN-Explorer (.trc, versions 1.0 to 2.1), line by line.
///
///   ;$FILEVERSION=1.1
///   ;$STARTTIME=42176.7577227546
///        1)        48.6  Rx     09F11201  8  FF 50 7A FF 7F FF 7F FD
///
/// Its beginning is local time, of this machine's zone (UTC where python-can wrote it); without one times count from zero. Bus 1 is can0.
/// Source: PEAK-System, PCAN Trace File Formats, 2.1.   Oracle: PcanTrace tests on canboat's sample and on what python-can 4.6 wrote
class PcanTraceReader {
 public:
  /// Whether a line is the beginning of one: all of its headers begin so.
  [[nodiscard]] static bool knows(std::string_view line) { return line.starts_with(';'); }
  [[nodiscard]] LineOr read(std::string_view line);

 private:
  void read_header(std::string_view line);
  [[nodiscard]] std::optional<Time> time_of(std::string_view milliseconds) const;

  /// A letter for each column: N number, O time, T type, B bus, I identifier, d direction, R reserved, L or l size, D data.
  std::string columns_ = "NOILD";
  std::int64_t begin_days_ = 0;
  std::int64_t begin_us_ = 0;  ///< of the day
  bool has_begin_ = false;
  bool is_utc_ = false;
};

}  // namespace earshot::hil
