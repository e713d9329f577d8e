#pragma once

#include <cstdint>

#include "firmware/core/status.hpp"

namespace earshot::n2k {

inline constexpr std::uint8_t kBroadcast = 255;    ///< destination of everyone
inline constexpr std::uint8_t kNullAddress = 254;  ///< source of a device that has no address

inline constexpr std::uint8_t kRuntimeAddress = 0x40;  ///< that Earshot claims first, unless its mission says another
inline constexpr std::uint8_t kVehicleAddress = 0x23;  ///< source of what the simulated vehicle sends; a real one's devices have their own

/// What the 29-bit CAN identifier of an NMEA 2000 frame says.
struct Identifier {
  std::uint32_t pgn = 0;      ///< parameter group number, 18 bits; of an addressed group (PDU1, PF < 240) the low byte is zero
  std::uint8_t priority = 6;  ///< 0 (most urgent) to 7
  std::uint8_t source = kNullAddress;
  std::uint8_t destination = kBroadcast;  ///< kBroadcast for a group that has no address (PDU2, PF >= 240)
  friend constexpr bool operator==(const Identifier&, const Identifier&) = default;
};

/// kOutOfRange: priority over 7, PGN over 18 bits, a low byte in an addressed PGN, or a destination in one that cannot have one.
/// Source: SAE J1939-21, 5.2.   Oracle: Identifier tests on recorded buses
[[nodiscard]] Result<std::uint32_t> compose(const Identifier& identifier);

/// Every 29-bit number is an identifier; kOutOfRange above.
[[nodiscard]] Result<Identifier> parse_identifier(std::uint32_t can_identifier);

}  // namespace earshot::n2k
