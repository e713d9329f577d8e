#pragma once

#include <cstddef>
#include <functional>
#include <optional>

#include "firmware/core/units.hpp"
#include "sim/pe/starter.hpp"

namespace earshot::pe {

/// What is left empty (or 0) is chosen from frequency, environment and accuracy: grid_choice.hpp.
struct Options {
  std::optional<Meters> depth_step = {};
  std::optional<Meters> range_step = {};            ///< of the march; output_step is a multiple of it, or it of output_step
  std::size_t terms = 0;                            ///< poles of the propagator, 2 to 16; a multiple of 4 fills the vector lanes
  std::optional<double> absorber_wavelengths = {};  ///< thickness of the absorber: absorber.hpp
  std::optional<Meters> output_step = {};           ///< between rows of the field; empty: range_step if given, else a sixth of a wavelength
  Decibels accuracy{0.02};                          ///< of transmission loss, mean over ranges
  Starter starter = Starter::kSelf;
};

/// Called now and then with the share of the work that is done, 0 to 1.
using Progress = std::function<void(double fraction)>;

}  // namespace earshot::pe
