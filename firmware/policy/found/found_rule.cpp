#include "firmware/policy/found/found_rule.hpp"

#include <algorithm>

#include "firmware/core/wide.hpp"
#include "firmware/policy/likelihood/belief_grid.hpp"

namespace earshot::policy {

EARSHOT_WIDE float probability_within(const BeliefModel& model, std::span<const float> probabilities, NorthEast position) {
  const auto size_north = static_cast<float>(cell_north(model));
  const auto size_east = static_cast<float>(cell_east(model));
  const auto vehicle_north = static_cast<float>(position.north.value);
  const auto vehicle_east = static_cast<float>(position.east.value);
  const auto reach = static_cast<float>(model.step_length.value);
  const float per_size = 1.0F / std::max(size_north, size_east);
  float sum = 0.0F;
  for (std::size_t n = 0; n < model.cells_north; ++n) {
    const float north = (static_cast<float>(n) + 0.5F) * size_north - vehicle_north;
    for (std::size_t e = 0; e < model.cells_east; ++e) {
      const float east = (static_cast<float>(e) + 0.5F) * size_east - vehicle_east;
      const float covered = (reach - __builtin_sqrtf(north * north + east * east)) * per_size + 0.5F;
      sum += probabilities[n * model.cells_east + e] * std::clamp(covered, 0.0F, 1.0F);
    }
  }
  return sum;
}

std::optional<messages::FoundDeclaration> FoundRule::judge(const BeliefModel& model, const FoundEvidence& evidence) {
  const std::uint32_t look = looks_++;
  const Reception& heard = evidence.reception;
  if (heard.too_faint || !(heard.snr >= evidence.least_snr)) return std::nullopt;
  const float probability = probability_within(model, evidence.probabilities, evidence.position);
  if (!(probability >= kNearProbability)) return std::nullopt;
  ++near_looks_;
  if (!(probability >= kFoundProbability) && near_looks_ < kNearLooks) return std::nullopt;
  const auto likeliest = std::max_element(evidence.probabilities.begin(), evidence.probabilities.end());
  const NorthEast way = way_to_cell(model, evidence.position, static_cast<std::size_t>(likeliest - evidence.probabilities.begin()));
  messages::FoundDeclaration declaration{.probability = probability,
                                         .snr = heard.snr,
                                         .least_snr = evidence.least_snr,
                                         .likeliest = evidence.position + way,
                                         .closest_approach = length_of(way),
                                         .look = look,
                                         .near_looks = near_looks_};
  near_looks_ = 0;
  return declaration;
}

}  // namespace earshot::policy
