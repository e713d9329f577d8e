#pragma once

#include <cstdint>

namespace earshot::host {

/// Counts what the kernel threw away because a socket's queue was full. It asks the kernel for the count: the kernel's own remark beside a
/// received message (SO_RXQ_OVFL) comes with the next message that gets through, which after a burst may be never.
class SocketDrops {
 public:
  /// Messages dropped so far; the count goes on where the kernel's 32 bits begin anew, if it is asked once before they do so twice.
  [[nodiscard]] std::uint64_t count(int socket) const;
  /// A socket takes the place of the last: the kernel counts from 0 again.
  void restart() { last_ = 0; }

 private:
  mutable std::uint64_t total_ = 0;
  mutable std::uint32_t last_ = 0;
};

}  // namespace earshot::host
