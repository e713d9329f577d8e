#pragma once

#include "firmware/core/units.hpp"

namespace earshot::policy {

/// What the hydrophone received of the source's call at one place.
struct Reception {
  Decibels snr;
  bool too_faint = false;  ///< true: too faint to measure; the signal lies somewhere below `snr`, the least that could have been measured
  friend constexpr bool operator==(Reception, Reception) = default;
};

}  // namespace earshot::policy
