#pragma once

#include "firmware/core/units.hpp"

namespace earshot::policy {

/// What the hydrophone made of the source's call at one place.
struct Heard {
  Decibels snr;
  bool too_faint = false;  ///< true: too faint to measure; the signal lies somewhere below `snr`, the least that could have been measured
  friend constexpr bool operator==(Heard, Heard) = default;
};

}  // namespace earshot::policy
