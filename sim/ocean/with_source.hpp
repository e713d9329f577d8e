#pragma once

#include <string>

#include "firmware/core/units.hpp"
#include "sim/ocean/environment.hpp"

namespace earshot::ocean {

/// The same ocean with a source of another frequency and depth: what its file would give, had it these two. The water absorbs at the new
/// frequency; levels and place stay.
///
/// @param frequency   1 to 10 000 Hz
/// @param depth       above 0 m; neither this nor the frequency is checked: who takes them from outside knows how they are written
/// @param depth_name  what the depth is called where it comes from: an option, an argument
/// Throws host::BadInput naming a depth that is not above the sea floor at the source.   Oracle: WithSource.*
[[nodiscard]] Environment with_source(const Environment& environment, Hertz frequency, Meters depth, const std::string& depth_name);

}  // namespace earshot::ocean
