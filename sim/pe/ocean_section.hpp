#pragma once

#include "firmware/core/units.hpp"
#include "sim/ocean/section.hpp"
#include "sim/pe/section.hpp"

namespace earshot::pe {

/// The solver's form of a radial of the ocean; what begins beyond range 0 begins at 0. A radial that meets land ends with depth 0 there.
///
/// Oracle: OceanSection.*
[[nodiscard]] Section make_section(const ocean::Section& radial, double water_attenuation_db_per_km);

/// The radial of `bearing` (clockwise from north) from the environment's source.
/// Throws host::BadInput as ocean::section_along does.
[[nodiscard]] Section make_section(const ocean::Environment& environment, Radians bearing, Meters max_range);

}  // namespace earshot::pe
