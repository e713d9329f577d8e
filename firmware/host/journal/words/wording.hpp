#pragma once

#include <string>

#include "firmware/core/geometry.hpp"
#include "firmware/core/time.hpp"

namespace earshot::journal {

/// "2026-11-22 15:04:07 UTC". @param time  host::is_dated()
[[nodiscard]] std::string utc(Time time);

/// "12000 m north, -350 m east"
[[nodiscard]] std::string to_string(NorthEast place);

/// Seconds on the mission's clock, to the microsecond.
[[nodiscard]] double seconds_of(Time time);

/// compass_degrees() with so many decimals, below 360 then, too; nothing of what is no number.
[[nodiscard]] std::string compass(Radians heading, int places);

}  // namespace earshot::journal
