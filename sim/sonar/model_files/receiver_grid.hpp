#pragma once

#include <vector>

#include "firmware/core/units.hpp"
#include "sim/ocean/environment.hpp"
#include "sim/sonar/radial_request.hpp"
#include "sim/sonar/sonar_field.hpp"

namespace earshot::sonar::model_files {

/// Where on a radial the file of another model holds numbers: also at the surface, at the source and below the sea floor.
struct ReceiverGrid {
  std::vector<double> depth_m;  ///< increasing, >= 0; empty: those of the field
  std::vector<double> range_m;  ///< increasing, >= 0, the last > 0; empty: those of the field
};

/// Makes a request cover a grid: its depths are those in the water; the step between its ranges is the longest one that all of the grid's
/// are multiples of, to a millimetre. Where that is shorter than a twelfth of a wavelength it is a twelfth.
/// @param bearing  of the radial, to know how deep the water is
/// Throws BadRequest where no depth lies in the water, and as ocean::section_along does. Oracle: ReceiverGrid.*
void cover(const ReceiverGrid& grid, const ocean::Environment& environment, Radians bearing, RadialRequest& request);

/// The field of such a request at the grid's own ranges and depths.
///
/// At the surface the pressure is zero and the loss kMaxTransmissionLoss. Below the sea floor, on land, and nearer to the source than the
/// field's first range is no number. Between two ranges of the field pressure times the root of range is linear, without the phase of k0 r,
/// or the loss in dB where the field has no pressure.
[[nodiscard]] SonarField at_receivers(const SonarField& field, const ReceiverGrid& grid);

}  // namespace earshot::sonar::model_files
