#pragma once

#include <cstdint>

namespace earshot::host {

/// How to open a link whose interface or network is not there.
enum class IfMissing : std::uint8_t {
  kRefuse,     ///< an error at once: in simulation, and for tools
  kKeepTrying  ///< at sea: the link is down, and may be there later
};

}  // namespace earshot::host
