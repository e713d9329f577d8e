#pragma once

#include "sim/ocean/file/acoustics_toolbox/top_options.hpp"
#include "sim/ocean/water/sound_speed.hpp"

namespace earshot::ocean::acoustics_toolbox {

/// A profile that is linear between its depths and nowhere more than 1 mm/s from one that goes on between those of `profile` in another
/// way: the same one where that is linear too.
///
/// The cubic spline has no knot at its second and last but one depth; of three depths it is a parabola, of two a straight line.
/// Source: de Boor, A Practical Guide to Splines, ch. IV, "not-a-knot". Oracle: InterpolatedProfile.*
[[nodiscard]] TabulatedProfile interpolated(const TabulatedProfile& profile, Interpolation interpolation);

}  // namespace earshot::ocean::acoustics_toolbox
