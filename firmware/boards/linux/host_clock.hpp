#pragma once

#include "firmware/core/time.hpp"

namespace earshot::board {

/// The two clocks of a host.
class HostClock {
 public:
  HostClock() = default;
  virtual ~HostClock() = default;
  HostClock(const HostClock&) = delete;
  HostClock& operator=(const HostClock&) = delete;

  /// What people and other hosts call the time. Somebody may set it, also back.
  [[nodiscard]] virtual Time utc() const;
  /// Since some moment before this process; runs on whatever happens to utc().
  [[nodiscard]] virtual Duration monotonic() const;
};

}  // namespace earshot::board
