#pragma once

#include <bitset>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace earshot::board {

/// What may be wrong with a port on a CAN bus, for a person.
enum class BusTrouble : std::uint8_t {
  kNoAddress,       ///< and nothing is sent without one
  kSameName,        ///< another device has our NAME
  kErrorPassive,    ///< the controller counts many errors
  kBusOff,          ///< it has left the bus
  kNoPosition,      ///< none is heard
  kOtherPosition,   ///< they come, but not from the device that the mission names
  kFarAway,         ///< positions are not in the mission's plane
  kNoHeading,       ///< none is heard
  kOtherHeading,    ///< likewise
  kNoVariation,     ///< headings are magnetic, and wait for it
  kNoDepth,         ///< no pressure is heard
  kOtherPressure,   ///< likewise
  kSurfaceUnknown,  ///< pressures are absolute, and wait for the START
  kNoSnr,           ///< none is heard
  kOtherSnr,        ///< likewise
  kFramesLost,      ///< on their way in
  kUnsent,          ///< messages
};
inline constexpr std::size_t kBusTroubleCount = 17;
using BusTroubles = std::bitset<kBusTroubleCount>;  ///< by BusTrouble

/// "no position is heard (129025, 129029)"
[[nodiscard]] std::string_view begin_of(BusTrouble trouble);
/// "positions are heard"; empty: its end is not told.
[[nodiscard]] std::string_view end_of(BusTrouble trouble);
/// "check the cables, their two ends and the bit rate"; empty: there is none.
[[nodiscard]] std::string_view hint_of(BusTrouble trouble);

}  // namespace earshot::board
