#include "hil/bus/recorders/log_reader.hpp"

#include <algorithm>

namespace earshot::hil {

LineOr LogReader::read(std::string_view line) {
  line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
  line = line.substr(0, line.find_last_not_of(" \t\r") + 1);
  return YachtDevicesReader::knows(line) ? yacht_devices_.read(line) : read_line(line);
}

}  // namespace earshot::hil
