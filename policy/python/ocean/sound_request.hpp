#pragma once

#include <cstddef>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "policy/python/boundary/checked.hpp"
#include "sim/ocean/environment.hpp"
#include "sim/sonar/model_files/receiver_grid.hpp"
#include "sim/sonar/radial_request.hpp"

namespace earshot::python {

/// What is asked of the sound in an ocean, as Python gives it. Checked where it is used, by bounds that are those of the options of
/// `earshot field`.
struct SoundRequest {
  double frequency_hz;
  double source_depth_m;
  double max_range_m;
  std::vector<double> receiver_depth_m;
  std::optional<double> depth_spacing_m;
  std::optional<double> output_step_m;
  double accuracy_db;
  std::optional<std::pair<double, double>> band_hz;
  std::size_t band_parts;
  std::string starter;
  std::optional<double> range_step_m;
  std::optional<double> depth_step_m;
  std::size_t terms;
  std::optional<double> absorber_wavelengths;
  sonar::model_files::ReceiverGrid receivers;  ///< of another model's file, which the field is to cover
};

/// The ocean with the source that is asked for. Throws BadInput.
[[nodiscard]] ocean::Environment ocean_of(const ocean::Environment& ocean, const SoundRequest& asked);

/// @param default_step_wavelengths  between ranges, where no step is asked for
/// Throws BadInput.
[[nodiscard]] sonar::RadialRequest request_of(const SoundRequest& asked, double default_step_wavelengths);

/// What the planner refuses, by the argument's name.
[[nodiscard]] BadArgument bad_argument(const sonar::BadRequest& bad);
/// What the solver cannot do, by the argument that says it, as far as its text shows.
[[nodiscard]] BadArgument bad_argument(const std::invalid_argument& bad);

}  // namespace earshot::python
