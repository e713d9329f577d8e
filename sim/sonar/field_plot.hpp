#pragma once

#include <filesystem>
#include <string>

#include "sim/sonar/sonar_field.hpp"

namespace earshot::sonar {

/// Draws the field's SNR against range and depth with gnuplot, as PNG or SVG by the path's extension; renamed into place when whole.
///
/// @param detection_threshold  where the colours change from cold to warm
/// Throws std::invalid_argument for another extension, std::runtime_error when gnuplot is missing or fails.
void plot_field(const std::filesystem::path& path, const SonarField& field, const std::string& title, Decibels detection_threshold);

}  // namespace earshot::sonar
