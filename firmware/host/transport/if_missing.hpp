#pragma once

#include <cstdint>

namespace earshot::host {

/// What it means that the interface or network of a link is not there when the link is opened.
enum class IfMissing : std::uint8_t {
  kRefuse,     ///< an error at once: in simulation, and for tools
  kKeepTrying  ///< at sea: the link is down, and may be there later
};

}  // namespace earshot::host
