#include "firmware/policy/found/found_rule.hpp"

#include <algorithm>
#include <utility>

namespace earshot::policy {

CellWindow cells_near(const BeliefModel& model, NorthEast position) {
  const auto size_north = static_cast<float>(cell_north(model));
  const auto size_east = static_cast<float>(cell_east(model));
  // Half a cell further no cell counts any more; another half, for what is rounded.
  const float radius = static_cast<float>(model.step_length.value) + std::max(size_north, size_east);
  return {.north = cells_along(static_cast<float>(position.north.value), radius, size_north, model.cells_north),
          .east = cells_along(static_cast<float>(position.east.value), radius, size_east, model.cells_east)};
}

float probability_within(const BeliefModel& model, std::span<const float> probabilities, NorthEast position) {
  const auto size_north = static_cast<float>(cell_north(model));
  const auto size_east = static_cast<float>(cell_east(model));
  const auto vehicle_north = static_cast<float>(position.north.value);
  const auto vehicle_east = static_cast<float>(position.east.value);
  const auto reach = static_cast<float>(model.step_length.value);
  const float per_size = 1.0F / std::max(size_north, size_east);
  const CellWindow near = cells_near(model, position);
  float sum = 0.0F;
  for (std::size_t n = near.north.first; n < near.north.end; ++n) {
    const float north = (static_cast<float>(n) + 0.5F) * size_north - vehicle_north;
    for (std::size_t e = near.east.first; e < near.east.end; ++e) {
      const float east = (static_cast<float>(e) + 0.5F) * size_east - vehicle_east;
      const float covered = (reach - __builtin_sqrtf(north * north + east * east)) * per_size + 0.5F;
      sum += probabilities[n * model.cells_east + e] * std::clamp(covered, 0.0F, 1.0F);
    }
  }
  return sum;
}

bool FoundRule::is_heard_near(const Reception& reception, Decibels least_snr) {
  return !reception.too_faint && reception.snr >= least_snr;  // not where it is no number
}

std::uint32_t FoundRule::judge(const FoundEvidence& evidence) {
  if (!is_heard_near(evidence.reception, evidence.least_snr) || !(evidence.probability >= kNearProbability)) return 0;
  ++near_measurements_;
  if (!(evidence.probability >= kFoundProbability) && near_measurements_ < kNearMeasurements) return 0;
  return std::exchange(near_measurements_, 0U);
}

}  // namespace earshot::policy
