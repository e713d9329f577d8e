#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "hil/bus/candump/log_line.hpp"

namespace earshot::hil {

/// Reads what a gateway of Yacht Devices writes (RAW), line by line.
///
///   17:33:21.107 R 09F11223 FF 70 5A FF 7F FF 7F FD
///
/// R is received from the bus, T sent to it. The time of day has no date: times count from the first line's midnight.
/// Source: Yacht Devices, YDWG-02 User Manual, appendix E.   Oracle: YachtDevices tests on canboat's samples
class YachtDevicesReader {
 public:
  /// Whether a line may be one of these.
  [[nodiscard]] static bool knows(std::string_view line);
  [[nodiscard]] LineOr read(std::string_view line);

 private:
  std::optional<std::int64_t> last_us_;  ///< of the day
  std::int64_t midnight_us_ = 0;
};

}  // namespace earshot::hil
