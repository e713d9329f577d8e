#pragma once

#include <span>
#include <vector>

#include "firmware/core/units.hpp"

namespace earshot::spectrum {

/// A band of a third of an octave, or rather a tenth of a decade.
struct ThirdOctave {
  Hertz centre;
  Hertz low;
  Hertz high;
};

/// The bands that lie whole between two frequencies.
///
///   centre = 1000 Hz * 10^(n / 10),   edges = centre * 10^(-+ 1/20)
///
/// Source: IEC 61260-1:2014, base ten.   Oracle: ThirdOctaves.HaveTheEdgesOfTheStandard
[[nodiscard]] std::vector<ThirdOctave> third_octaves(Hertz lowest, Hertz highest);

/// Mean square in a band, of a density whose bins reach half their width to either side; a bin on an edge counts by the share of it that
/// lies inside. A band narrower than a few bins is smeared by the window: from 10 Hz up it is not, with bins of 1 Hz.
/// @param psd  as ShortTimeSpectrum gives it
[[nodiscard]] double power_in(std::span<const float> psd, Hertz bin_width, Hertz low, Hertz high);

}  // namespace earshot::spectrum
