#pragma once

#include <array>
#include <cstdint>

#include "firmware/core/time.hpp"

namespace earshot::board {

/// Of a start of the computer, as its kernel drew it; nothing but zeros: not known.
using BootId = std::array<std::uint8_t, 16>;

/// The clocks of a host.
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
  /// Since this computer started, with the time that it slept. Whatever process reads it: it is one clock until the computer starts again.
  [[nodiscard]] virtual Duration since_boot() const;
  [[nodiscard]] virtual BootId boot() const;
};

}  // namespace earshot::board
