#pragma once

#include <string_view>

#include "hil/bus/candump/log_line.hpp"
#include "hil/bus/recorders/yacht_devices.hpp"

namespace earshot::hil {

/// Reads the lines of one log, whoever recorded it.
class LogReader {
 public:
  /// @param line  without its end; any bytes
  [[nodiscard]] LineOr read(std::string_view line);

 private:
  YachtDevicesReader yacht_devices_;
};

}  // namespace earshot::hil
