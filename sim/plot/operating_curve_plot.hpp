#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "sim/annotation/score.hpp"

namespace earshot::plot {

/// Draws what each threshold gives, side by side: recall against false alarms per hour (ROC), and misses against false alarms on
/// logarithmic axes (DET), with the thresholds written beside their points.
/// @param points  by rising threshold; at least one truth in each
/// Throws as draw() does.
void plot_operating_curve(const std::filesystem::path& path, const std::vector<annotation::OperatingPoint>& points,
                          const std::string& title, const std::string& subtitle);

}  // namespace earshot::plot
