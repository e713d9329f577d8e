#include "firmware/policy/frozen_policy.hpp"

namespace earshot::policy {
namespace {

/// False for a NaN too.
bool is_within_tolerance(Meters a, Meters b) {
  return a - b <= kAreaSizeTolerance && b - a <= kAreaSizeTolerance;
}

}  // namespace

void find_logits(const FrozenPolicy& policy, std::span<const float> observation, std::span<float> logits) {
  if (has_network(policy.network)) return forward(policy.network, observation, logits);
  for (std::size_t i = 0; i < observation.size(); ++i) {
    const ObservationElement& element = policy.observation.spec[i];
    if (element.feature == Feature::kPreference) logits[element.age] = observation[i];
  }
}

SearchedSound searched_sound(const config::Mission& mission) {
  return {.vehicle_depth = mission.search_depth,
          .frequency = mission.source_frequency,
          .furthest = range_between(mission.operating_area.south_west, mission.operating_area.north_east)};
}

Mismatch mismatch(const FrozenPolicy& policy, const config::Mission& mission) {
  const NorthEast size = mission.operating_area.north_east - mission.operating_area.south_west;
  const bool same_size = is_within_tolerance(policy.area_size.north, size.north) && is_within_tolerance(policy.area_size.east, size.east);
  if (policy.step_length != mission.step_length) return Mismatch::kStepLength;
  if (!same_size) return Mismatch::kAreaSize;
  if (policy.detection_threshold != mission.detection_threshold) return Mismatch::kDetectionThreshold;
  if (policy.observation.listening != mission.listening) return Mismatch::kListening;
  return Mismatch::kNone;
}

}  // namespace earshot::policy
