#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "firmware/core/geometry.hpp"
#include "firmware/core/time.hpp"

namespace earshot::journal {

/// Whether a clock that says this is one of dates; a simulator's begins at 0.
[[nodiscard]] bool is_dated(Time time);

/// "2026-11-22 15:04:07 UTC". @param time  is_dated()
[[nodiscard]] std::string utc(Time time);

/// "12.30"; "nan" and "inf" as they are.
[[nodiscard]] std::string decimal(double number, int places);

/// "1 record", "12 records"
[[nodiscard]] std::string counted(std::uint64_t count, std::string_view what);

/// "12000 m north, -350 m east"
[[nodiscard]] std::string to_string(NorthEast place);

/// Seconds on the mission's clock, to the microsecond.
[[nodiscard]] double seconds_of(Time time);

/// Clockwise from north, [0, 360).
[[nodiscard]] double compass_degrees(Radians heading);
/// Likewise with so many decimals, below 360 then, too; nothing of what is no number.
[[nodiscard]] std::string compass(Radians heading, int places);

}  // namespace earshot::journal
