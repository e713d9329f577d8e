#pragma once

#include <cstdint>

namespace earshot::messages {

/// No port could send the last turn's set-point. This computer's own port (kOwnPort) brings one after every such turn.
struct UnsentSetpoints {
  std::uint64_t count = 0;  ///< of the whole mission so far, this one included
  friend constexpr bool operator==(const UnsentSetpoints&, const UnsentSetpoints&) = default;
};

}  // namespace earshot::messages
