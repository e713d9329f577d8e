#pragma once

#include "firmware/core/time.hpp"
#include "firmware/core/units.hpp"
#include "firmware/messages/ranges.hpp"

namespace earshot::messages {

/// No SNR is greater, either side of zero.
inline constexpr Decibels kMostSnr{kSnr_db.highest};

/// False for a NaN.
[[nodiscard]] constexpr bool is_possible_snr(Decibels snr) {
  return kSnr_db.contains(snr.value);
}

/// The SNR at the hydrophone, measured over an interval: from the detector at sea, from the PE model over the simulation link.
struct SnrMeasurement {
  Time time;  ///< end of the interval
  Decibels snr;
  bool too_faint = false;  ///< not measured: the signal lies somewhere below `snr`, the least that could have been measured
  friend constexpr bool operator==(const SnrMeasurement&, const SnrMeasurement&) = default;
};

}  // namespace earshot::messages
