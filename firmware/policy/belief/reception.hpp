#pragma once

#include <optional>

#include "firmware/core/units.hpp"
#include "firmware/messages/bearing_measurement.hpp"

namespace earshot::policy {

/// What the hydrophone received of the source's call at one place.
struct Reception {
  Decibels snr;
  bool too_faint = false;  ///< true: too faint to measure; the signal lies somewhere below `snr`, the least that could have been measured
  std::optional<messages::Bearing> bearing = std::nullopt;  ///< messages::is_possible(); absent: none was measured, which says nothing
  friend constexpr bool operator==(const Reception&, const Reception&) = default;
};

}  // namespace earshot::policy
