#pragma once

#include <string_view>
#include <variant>

#include "hil/bus/candump/log_line.hpp"
#include "hil/bus/recorders/canboat_plain.hpp"
#include "hil/bus/recorders/pcan_trace.hpp"
#include "hil/bus/recorders/savvycan_csv.hpp"
#include "hil/bus/recorders/vector_asc.hpp"
#include "hil/bus/recorders/yacht_devices.hpp"

namespace earshot::hil {

/// Reads the lines of one log, whoever recorded it. A header says whose it is until the end; else each line's form does.
class LogReader {
 public:
  /// @param line  without its end; any bytes
  [[nodiscard]] LineOr read(std::string_view line);

 private:
  std::variant<std::monostate, PcanTraceReader, SavvyCanReader, VectorAscReader> headed_;
  CanboatReader canboat_;
  YachtDevicesReader yacht_devices_;
};

}  // namespace earshot::hil
