#pragma once

#include <cstdint>

namespace earshot::messages {

/// Port 0 of every input: this computer itself. Its report is its journal's.
inline constexpr std::uint8_t kOwnPort = 0;

/// What one port says of itself; counters only grow. A hydrophone's counts samples of one channel where others count messages handed on
/// and lost.
struct PortReport {
  std::uint8_t port = 0;        ///< its index
  bool link_up = true;          ///< false: it cannot be read or written at present
  std::uint64_t received = 0;   ///< messages handed on
  std::uint64_t lost = 0;       ///< arrived faster than they were taken: dropped by the kernel or pushed out of a queue
  std::uint64_t malformed = 0;  ///< bytes that are no message of ours, or do not follow their format
  std::uint64_t unsent = 0;     ///< messages that could not be put on the bus
  friend constexpr bool operator==(const PortReport&, const PortReport&) = default;
};

}  // namespace earshot::messages
