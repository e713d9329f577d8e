#pragma once

#include "firmware/core/geometry.hpp"
#include "firmware/core/units.hpp"
#include "sim/ocean/environment.hpp"
#include "sim/ocean/section.hpp"

namespace earshot::ocean {

/// Whether every section of the environment is alike and range-independent: `water` and `seabed` tell all of it.
[[nodiscard]] bool is_range_independent(const Environment& environment);

/// The radial of `bearing` from `from`, as far as `max_range` or the shore.
///
/// Range is true distance along a geodesic where the environment has a geographic origin; the bearing is that of the local plane, in which
/// the geodesic ends at `from` + `max_range` in this direction. Stations stand half a grid cell of the charts apart, which bilinear charts
/// lose nothing but the curvature inside a cell by. What the environment gives against range (not charts) starts anew at `from`, and what
/// begins beyond range 0 there is the same from 0 on. A radial that meets land ends with depth 0 there.
///
/// @param bearing    clockwise from north
/// @param max_range  > 0
/// Throws host::BadInput where a chart has no data, or where `from` is on land.
/// Oracle: SectionAlong.*
[[nodiscard]] Section section_along(const Environment& environment, NorthEast from, Radians bearing, Meters max_range);

}  // namespace earshot::ocean
