#pragma once

#include "firmware/core/units.hpp"
#include "sim/ocean/section.hpp"

namespace earshot::pe {

/// Everything that the solver needs to be true of a section and a source in it.
///
/// Throws std::invalid_argument that names the quantity, its value and what is allowed: ranges that do not start at 0 or do not increase, a
/// sea floor above the surface (at the surface it may lie: a shore), sound speed, density or attenuation out of range or not finite, a
/// source not in the water. Oracle: Section.Refuses*
void require_valid(const ocean::Section& section, Meters source_depth);

}  // namespace earshot::pe
