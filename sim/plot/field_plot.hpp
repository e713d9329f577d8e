#pragma once

#include <filesystem>

#include "firmware/core/units.hpp"
#include "sim/ocean/environment.hpp"
#include "sim/sonar/detection.hpp"
#include "sim/sonar/fan.hpp"
#include "sim/sonar/radial.hpp"
#include "sim/sonar/sonar_field.hpp"

namespace earshot::plot {

/// Draws the field's SNR against range and depth, or curves (plot_curves) where it has no more than eight depths or one range, with
/// gnuplot, as PNG or SVG by the path's extension; renamed into place when whole. The source, the sea floor and the detection threshold,
/// where the colours change from cold to warm, are marked.
///
/// Throws std::invalid_argument for another extension, std::runtime_error when gnuplot is missing or fails.
void plot_field(const std::filesystem::path& path, const sonar::SonarField& field, const ocean::Environment& environment,
                const ocean::Band& band, Radians bearing, Decibels detection_threshold);

/// Draws what a plane of few depths cannot show: transmission loss and SNR against range, one above the other, for each depth of the field
/// (the first eight). The detection threshold is a line. Throws as plot_field does.
void plot_curves(const std::filesystem::path& path, const sonar::SonarField& field, const ocean::Environment& environment,
                 const ocean::Band& band, Radians bearing, Decibels detection_threshold);

/// Draws SNR and probability of detection around the source at the fan's first depth, with the assured and the furthest range of
/// detection on every bearing.
///
/// @param side  of the square
void plot_map(const std::filesystem::path& path, const sonar::Fan& fan, const ocean::Environment& environment, const ocean::Band& band,
              Meters side, const sonar::Detector& detector);

}  // namespace earshot::plot
