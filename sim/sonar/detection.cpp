#include "sim/sonar/detection.hpp"

#include <cmath>
#include <limits>
#include <numbers>

namespace earshot::sonar {
namespace {

DetectionRange detection_range(const Fan& fan, std::size_t bearing, std::size_t depth, const Detector& detector) {
  const auto excess_db = [&](std::size_t range) {
    const double loss_db = static_cast<double>(fan.at(bearing, range, depth));
    return (detector.snr(Decibels{loss_db}) - detector.detection_threshold).value;
  };
  const double step_m = fan.range_step.value;
  const auto range_m = [&](std::size_t range) { return static_cast<double>(range + 1) * step_m; };
  if (std::isnan(excess_db(0))) return {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::quiet_NaN()};

  DetectionRange result{.assured_m = 0.0, .furthest_m = 0.0};
  bool unbroken = true;
  for (std::size_t i = 0; i < fan.ranges; ++i) {
    const double here = excess_db(i);
    if (!(here >= 0.0)) {
      unbroken = false;
      continue;
    }
    const double next = i + 1 < fan.ranges ? excess_db(i + 1) : std::numeric_limits<double>::quiet_NaN();
    result.furthest_m = range_m(i) + (next < 0.0 ? step_m * here / (here - next) : 0.0);
    if (unbroken) result.assured_m = result.furthest_m;
  }
  return result;
}

}  // namespace

double detection_probability(Decibels snr, const Detector& detector) {
  const double excess_db = (snr - detector.detection_threshold).value;
  if (std::isnan(excess_db)) return excess_db;
  if (detector.fluctuation.value == 0.0) return excess_db >= 0.0 ? 1.0 : 0.0;
  return 0.5 * std::erfc(-excess_db / (detector.fluctuation.value * std::numbers::sqrt2));
}

std::vector<float> detection_probabilities(const Fan& fan, const Detector& detector) {
  std::vector<float> probability;
  probability.reserve(fan.transmission_loss_db.size());
  for (const float loss_db : fan.transmission_loss_db)
    probability.push_back(static_cast<float>(detection_probability(detector.snr(Decibels{static_cast<double>(loss_db)}), detector)));
  return probability;
}

std::vector<DetectionRange> detection_ranges(const Fan& fan, std::size_t depth, const Detector& detector) {
  std::vector<DetectionRange> ranges;
  for (std::size_t bearing = 0; bearing < fan.bearings; ++bearing) ranges.push_back(detection_range(fan, bearing, depth, detector));
  return ranges;
}

}  // namespace earshot::sonar
