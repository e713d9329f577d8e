#pragma once

#include <complex>
#include <cstddef>
#include <optional>

#include "firmware/core/units.hpp"
#include "sim/ocean/section.hpp"

namespace earshot::pe {

/// What stands below the grid for the half-space that goes on for ever: elements of complex length that grow geometrically downward, with
/// no pressure below the last.
///
///   l_j = shortest growth^j exp(i pi / 4),   R(gamma) = product of ((1 + i gamma l_j / 2) / (1 - i gamma l_j / 2))^2
///
/// gamma is the vertical wavenumber. The elements are matched to the half-space whatever their length, so that only what comes back from
/// the end is reflected: a wave is lost in those elements that are about as long as it is, and a few more elements serve waves ten times
/// closer to grazing.
/// Source: Guddati & Lim, Int. J. Numer. Meth. Engng 66 (2006) 949 (layers matched after discretisation); the geometric lengths are
///   Druskin's and Knizhnerman's, Numer. Linear Algebra Appl. 7 (2000) 27, in spirit.   Oracle: Absorber.*, DepthOperator.*
struct Absorber {
  double shortest_m;
  double growth;
  std::size_t elements;

  [[nodiscard]] std::complex<double> length_m(std::size_t element) const;
  /// |R|, of amplitude, for a wave that comes down with exp(i gamma z).
  [[nodiscard]] double reflection(std::complex<double> vertical_wavenumber_per_m) const;
  /// Of all elements together.
  [[nodiscard]] double thickness_m() const;
};

/// The absorber that a section needs: from a sixth of the shortest wavelength in its half-spaces to what the most grazing wave that matters
/// is long. That wave is set by the range, over which nearer ones to grazing turn by less than a thirtieth of a radian, and by the
/// attenuation of the half-space that loses least.
///
/// @param max_range    > 0
/// @param wavelengths  its thickness in wavelengths of the fastest half-space, > 0; empty: as above
[[nodiscard]] Absorber choose_absorber(const ocean::Section& section, Hertz frequency, Meters max_range, std::optional<double> wavelengths);

/// The largest |R| over the waves that matter, in any of the half-spaces.
[[nodiscard]] double largest_reflection(const Absorber& absorber, const ocean::Section& section, Hertz frequency, Meters max_range);

}  // namespace earshot::pe
