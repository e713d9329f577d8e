#include "sim/plot/depth_rows.hpp"

#include <cmath>

namespace earshot::plot {

DepthRows depth_rows(std::span<const double> depth_m, std::size_t rows) {
  const double first_spacing = depth_m[1] - depth_m[0];
  const double last_spacing = depth_m.back() - depth_m[depth_m.size() - 2];
  const double top = depth_m[0] <= first_spacing ? 0.0 : depth_m[0] - 0.5 * first_spacing;
  const double base = depth_m.back() + 0.5 * last_spacing;
  DepthRows picture;
  std::size_t nearest = 0;
  for (std::size_t row = 0; row < rows; ++row) {
    const double depth = top + (static_cast<double>(row) + 0.5) * (base - top) / static_cast<double>(rows);
    while (nearest + 1 < depth_m.size() && depth > 0.5 * (depth_m[nearest] + depth_m[nearest + 1])) ++nearest;
    picture.depth_m.push_back(depth);
    picture.of_field.push_back(nearest);
  }
  return picture;
}

float snr_to_draw(const sonar::SonarField& field, std::size_t range, std::size_t depth) {
  float snr_db = field.snr_db(range, depth);
  while (std::isnan(snr_db) && depth > 0 && field.depth_m[depth] >= static_cast<double>(field.sea_floor_depth_m[range]))
    snr_db = field.snr_db(range, --depth);
  return snr_db;
}

}  // namespace earshot::plot
