#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "hil/bus/candump/log_line.hpp"

namespace earshot::hil {

/// What a recorder's line says of one CAN frame with data.
struct RecordedFrame {
  std::optional<Time> time;
  unsigned bus = 0;  ///< from 0 on: "can0"
  std::string_view identifier;
  bool is_extended = false;  ///< 29 bits; of 11 bits NMEA 2000 has no use
  std::string_view size;     ///< hexadecimal, of bytes; over 8 it is CAN FD
  std::string_view data;     ///< bytes with blanks between them; what stands behind them is passed over
  int base = 16;             ///< of identifier and bytes
};

/// @return the frame's entry, or what is wrong with it
[[nodiscard]] LineOr entry_of(const RecordedFrame& recorded);

/// A frame that NMEA 2000 has no use for.
[[nodiscard]] LogEntry other_frame(std::optional<Time> time, unsigned bus);

}  // namespace earshot::hil
