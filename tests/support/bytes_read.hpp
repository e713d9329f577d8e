#pragma once

#include <cstdint>
#include <fstream>
#include <stdexcept>
#include <string>

namespace earshot::support {

/// How many bytes this process has read since it began, of files and all else, whether from a disk or from memory. Asking reads some 100
/// more.
inline std::uint64_t bytes_read() {
  std::ifstream counters("/proc/self/io");
  std::string name;
  std::uint64_t value = 0;
  while (counters >> name >> value) {
    if (name == "rchar:") return value;
  }
  throw std::runtime_error("/proc/self/io does not tell how much was read");
}

}  // namespace earshot::support
