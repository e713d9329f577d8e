#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "hil/bus/candump/log_line.hpp"

namespace earshot::hil {

/// Reads a log of Vector's tools (.asc), line by line, also what can-utils' log2asc writes.
///
///   date Tue Nov 14 22:13:20.000 2023
///   base hex  timestamps absolute
///      0.010600 1  9F11223x        Rx   d 8 FF 70 5A FF 7F FF 7F FD
///
/// Its date is local time, of this machine's zone; without one times count from zero. Channel 1 is can0, as for can-utils' asc2log.
/// Events that are no frames are passed over.
/// Source: can-utils, asc2log.c and log2asc.c (what they read and write).   Oracle: VectorAsc tests on what python-can 4.6 and log2asc
/// wrote
class VectorAscReader {
 public:
  /// Whether a line is one of its first two.
  [[nodiscard]] static bool knows(std::string_view line);
  [[nodiscard]] LineOr read(std::string_view line);

 private:
  [[nodiscard]] LineOr read_date(std::string_view date);
  void read_base(std::string_view line);
  [[nodiscard]] std::optional<Time> time_of(std::string_view seconds);
  [[nodiscard]] LineOr read_event(Time time, std::string_view line) const;
  /// What stands behind the channel.
  [[nodiscard]] LineOr read_classic(Time time, unsigned bus, std::string_view line) const;

  std::int64_t begin_us_ = 0;
  std::int64_t last_us_ = 0;
  int base_ = 16;
  bool is_relative_ = false;  ///< stamps count from the one before
};

}  // namespace earshot::hil
