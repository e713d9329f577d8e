#pragma once

#include "firmware/core/time.hpp"
#include "firmware/core/units.hpp"

namespace earshot::messages {

/// No SNR is greater, either side of zero, whether heard or modelled: a source of 0 to 300 dB, a transmission loss of up to 300 dB and
/// noise of -100 to 300 dB are the most that an ocean's file may hold. A look beyond it would drag a window's mean along with it.
inline constexpr Decibels kMostSnr{600.0};

/// False for a NaN.
[[nodiscard]] constexpr bool is_possible_snr(Decibels snr) {
  return snr >= -kMostSnr && snr <= kMostSnr;
}

/// The SNR at the hydrophone, measured over an interval: from the detector at sea, from the PE model over the simulation link.
struct SnrMeasurement {
  Time time;  ///< end of the interval
  Decibels snr;
  bool too_faint = false;  ///< not measured: the signal lies somewhere below `snr`, the least that could have been measured
  friend constexpr bool operator==(const SnrMeasurement&, const SnrMeasurement&) = default;
};

}  // namespace earshot::messages
