#pragma once

#include "firmware/messages/snr_measurement.hpp"

namespace earshot::policy {

// Wider than any search, and narrow enough that no float overflows on the way.

inline constexpr double kLeastLength_m = 1.0;
inline constexpr double kMostStep_m = 1e6;                         ///< of a border too
inline constexpr double kMostArea_m = 1e7;                         ///< along one side
inline constexpr double kMostLevel_db = messages::kMostSnr.value;  ///< of SNRs and offsets between them, either side of zero

/// False for a NaN.
[[nodiscard]] constexpr bool is_within(double x, double least, double most) {
  return x >= least && x <= most;
}

}  // namespace earshot::policy
