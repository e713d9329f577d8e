#pragma once

#include "firmware/core/units.hpp"
#include "sim/ocean/environment.hpp"

namespace earshot::ocean {

/// The same ocean with a source of another frequency and depth: what its file would give, had it these two. The water absorbs at the new
/// frequency; levels and place stay.
///
/// @param frequency  1 to 10 000 Hz
/// @param depth      above 0 m and above the sea floor
/// Not checked: who takes them from outside does.   Oracle: WithSource.*
[[nodiscard]] Environment with_source(const Environment& environment, Hertz frequency, Meters depth);

}  // namespace earshot::ocean
