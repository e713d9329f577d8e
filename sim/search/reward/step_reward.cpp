#include "sim/search/reward/step_reward.hpp"

#include "firmware/detector/threshold_detector.hpp"

namespace earshot::search {

bool is_detection(const SearchSettings& s, policy::Reception reception) {
  return !reception.too_faint && detector::ThresholdDetector{s.detection_threshold}.detects(reception.snr);
}

double step_reward(const SearchSettings& s, NorthEast position, policy::Reception reception) {
  const double reward = is_detection(s, reception) ? 0.0 : -1.0;
  const Meters to_edge = s.domain.distance_to_edge(position);
  if (to_edge >= s.border_width) return reward;
  return reward + s.border_reward * ((s.border_width - to_edge) / s.border_width);
}

double step_reward(const SearchSettings& s, NorthEast position, Decibels snr) {
  return step_reward(s, position, policy::Reception{.snr = snr});
}

}  // namespace earshot::search
