#pragma once

#include <cstdint>

#include "firmware/core/geometry.hpp"
#include "firmware/core/units.hpp"

namespace earshot::messages {

/// The vehicle says that it has found the source, and why.
struct FoundDeclaration {
  float probability = 0.0F;       ///< that the source lies within a step length of the vehicle, by all that was heard
  Decibels snr;                   ///< heard at that place
  Decibels least_snr;             ///< that is expected within a step length of the source: what was heard is no less
  NorthEast likeliest;            ///< centre of the likeliest cell
  Meters closest_approach;        ///< from there to the vehicle
  std::uint32_t measurement = 0;  ///< which measurement it was, the one at the start being 0
  std::uint32_t near_measurements =
      0;  ///< at which it was likelier within a step length than not, since the one declared before: this is one
  friend constexpr bool operator==(const FoundDeclaration&, const FoundDeclaration&) = default;
};

}  // namespace earshot::messages
