#pragma once

#include <filesystem>
#include <string>

#include "sim/sonar/detection.hpp"
#include "sim/sonar/fan.hpp"
#include "sim/sonar/horizontal_map.hpp"
#include "sim/sonar/sonar_field.hpp"

namespace earshot::sonar {

/// Draws the field's SNR against range and depth with gnuplot, as PNG or SVG by the path's extension; renamed into place when whole.
///
/// @param detection_threshold  where the colours change from cold to warm
/// Throws std::invalid_argument for another extension, std::runtime_error when gnuplot is missing or fails.
void plot_field(const std::filesystem::path& path, const SonarField& field, const std::string& title, Decibels detection_threshold);

/// Draws a map's SNR with the ring of furthest detection, and beside it the probability of detection when the SNR fluctuates.
void plot_map(const std::filesystem::path& path, const HorizontalMap& map, const Fan& fan, const std::string& title,
              const Detector& detector);

}  // namespace earshot::sonar
