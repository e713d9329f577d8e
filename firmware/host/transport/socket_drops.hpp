#pragma once

#include <cstdint>

namespace earshot::host {

/// Counts what the kernel threw away because a socket's queue was full. Asked for, not told: the kernel's remark beside a received message
/// (SO_RXQ_OVFL) comes with the next message that gets through, which after a burst may be never.
class SocketDrops {
 public:
  /// What was dropped so far; goes on where the kernel's 32 bits begin anew, if it is asked once before they do so twice.
  [[nodiscard]] std::uint64_t count(int socket) const;
  /// A socket takes the place of the last: the kernel counts from 0 again.
  void restart() { last_ = 0; }

 private:
  mutable std::uint64_t total_ = 0;
  mutable std::uint32_t last_ = 0;
};

}  // namespace earshot::host
