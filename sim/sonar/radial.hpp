#pragma once

#include <complex>
#include <cstddef>
#include <numbers>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "firmware/core/geometry.hpp"
#include "firmware/core/units.hpp"
#include "sim/ocean/band.hpp"
#include "sim/ocean/environment.hpp"
#include "sim/ocean/section.hpp"
#include "sim/pe/options.hpp"
#include "sim/pe/solver.hpp"

namespace earshot::sonar {

/// The frequencies of a band over which intensity is averaged, increasing: the middles of its parts; the low one alone when it has no
/// width.
[[nodiscard]] std::vector<double> frequencies_hz(const ocean::Band& band);

/// Where on a radial transmission loss is wanted, and of which sound.
///
/// The march starts at `source_depth`. By reciprocity the loss from there to a depth at some range is that from that depth and range to a
/// hydrophone at `source_depth`: one march for many source depths around one hydrophone.
struct RadialPlan {
  Meters source_depth;
  std::vector<double> depth_m;  ///< each >= 0
  Meters range_step;            ///< of the result, > 0
  std::size_t ranges;           ///< >= 1; the first at range_step
  ocean::Band band;
  pe::Options options = {};  ///< its output_step is not used

  [[nodiscard]] Meters max_range() const { return static_cast<double>(ranges) * range_step; }
};

/// Transmission loss along one radial, [n_range x n_depth] with depth running fastest.
///
///   TL = -10 log10 (1/n sum_i |p(f_i)|^2)        (band: incoherent average of equally loud frequencies)
///
/// NaN below the sea floor, and from the shore outward: a hydrophone cannot be there.
struct RadialLoss {
  std::span<float> transmission_loss_db;  ///< [n_range x n_depth]
  std::span<float> sea_floor_depth_m;     ///< [n_range]; 0 from the shore outward
  /// Empty, or of the one frequency of a band without width: pe::Field's pressure, NaN where the loss is.  [n_range x n_depth]
  std::span<std::complex<double>> pressure = {};
};

/// Whether sections of an environment differ from bearing to bearing or from one source position to another.
[[nodiscard]] bool differs_with_place(const ocean::Environment& environment);

/// The j-th of `bearings` equally spaced ones; the first is north.
[[nodiscard]] constexpr Radians bearing_of(std::size_t j, std::size_t bearings) {
  return Radians{2.0 * std::numbers::pi * static_cast<double>(j) / static_cast<double>(bearings)};
}

/// The deepest sea floor on one radial, from its source to `max_range`.
[[nodiscard]] Meters deepest_sea_floor(const ocean::Section& section, Meters max_range);

/// Where the radial meets land, if it does so nearer than `range`: from there on a field of it has no number.
[[nodiscard]] std::optional<Meters> shore_before(const ocean::Section& section, Meters range);

/// Fills `loss` for one radial. May be called from many threads.
///
/// @param section  of the radial, as far as the plan goes: ocean::section_along
/// @param name     of the ocean, for the exception
/// @return the grid of the march, of the band's highest frequency; nothing where there was nothing to march through
/// Throws std::invalid_argument where the solver cannot serve, std::runtime_error where its sound is not a finite number.
/// Oracle: Radial.*
std::optional<pe::MarchGrid> compute_radial(const ocean::Section& section, const std::string& name, const RadialPlan& plan,
                                            const RadialLoss& loss, const pe::Progress& progress = {});

}  // namespace earshot::sonar
