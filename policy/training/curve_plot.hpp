#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace earshot::training {

/// Draws reward against episodes, as the paper's Fig. 5: median of the last 50 episodes and their quartiles; of several trainings the
/// median and the quartiles of their medians. Throws host::BadInput when it cannot be drawn.
/// @param title         over the curve: what was trained
/// @param episodes_csv  one a training, as LearningCurve has it
void draw_curves(const std::filesystem::path& path, const std::string& title, std::span<const std::string> episodes_csv);

/// The points of the curve that draw_curves() draws. Oracle: CurvePlot.*
struct CurvePoint {
  std::size_t episode;
  double lower;
  double median;
  double upper;
};
[[nodiscard]] std::vector<CurvePoint> points_of(std::span<const std::string> episodes_csv);

}  // namespace earshot::training
