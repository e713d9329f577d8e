#include "firmware/policy/frozen_policy.hpp"

namespace earshot::policy {
namespace {

/// False for a NaN too.
bool is_within_tolerance(Meters a, Meters b) {
  return a - b <= kAreaSizeTolerance && b - a <= kAreaSizeTolerance;
}

}  // namespace

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
