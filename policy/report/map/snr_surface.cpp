#include "policy/report/map/snr_surface.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "policy/explain/action_map.hpp"
#include "policy/report/map/kilometres.hpp"

namespace earshot::report {
namespace {

/// Intensity of a curve, integrated over range from 0.
class Integral {
 public:
  explicit Integral(const sonar::SnrCurve& curve) : step_m_(curve.range_step().value) {
    for (const float snr_db : curve.samples_db()) intensity_.push_back(std::pow(10.0, 0.1 * static_cast<double>(snr_db)));
    until_.push_back(0.0);
    for (std::size_t i = 1; i < intensity_.size(); ++i)
      until_.push_back(until_.back() + 0.5 * step_m_ * (intensity_[i - 1] + intensity_[i]));
  }

  [[nodiscard]] double mean(double from_m, double to_m) const { return (until(to_m) - until(from_m)) / (to_m - from_m); }

 private:
  /// Trapezoids; beyond the curve's end as at its end.
  [[nodiscard]] double until(double range_m) const {
    const double position = std::max(0.0, range_m / step_m_);
    const std::size_t i = std::min(static_cast<std::size_t>(position), until_.size() - 1);
    const double beyond = position - static_cast<double>(i);
    const double slope = i + 1 < intensity_.size() ? intensity_[i + 1] - intensity_[i] : 0.0;
    return until_[i] + step_m_ * beyond * (intensity_[i] + 0.5 * beyond * slope);
  }

  double step_m_;
  std::vector<double> intensity_;
  std::vector<double> until_;  ///< from range 0 to each sample
};

}  // namespace

std::vector<double> snr_surface(const sonar::SnrCurve& curve, NorthEast source, const Rectangle& area, std::size_t per_side) {
  const Integral intensity(curve);
  const NorthEast size = area.north_east - area.south_west;
  const double half_m = 0.5 * size.north.value / static_cast<double>(per_side);
  std::vector<double> snr_db;
  for (const NorthEast centre : explain::cell_centres(size, per_side)) {
    const double range_m = range_between(area.south_west + centre, source).value;
    snr_db.push_back(10.0 * std::log10(intensity.mean(std::max(0.0, range_m - half_m), range_m + half_m)));
  }
  return snr_db;
}

std::string snr_rows(const sonar::SnrCurve& curve, NorthEast source, const Rectangle& area, std::size_t per_side) {
  const std::vector<double> snr_db = snr_surface(curve, source, area, per_side);
  const std::vector<NorthEast> centres = explain::cell_centres(area.north_east - area.south_west, per_side);
  std::ostringstream rows;
  for (std::size_t i = 0; i < snr_db.size(); ++i) rows << km(area.south_west + centres[i]) << ' ' << snr_db[i] << '\n';
  return rows.str();
}

}  // namespace earshot::report
