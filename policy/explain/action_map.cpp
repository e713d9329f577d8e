#include "policy/explain/action_map.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include "firmware/policy/action_draw.hpp"
#include "policy/explain/baseline.hpp"
#include "policy/explain/wording.hpp"

namespace earshot::explain {
namespace {

using policy::FrozenPolicy;
using policy::SearchMemory;

void set_heading(const FrozenPolicy& policy, MapPoint& point) {
  double north = 0.0;
  double east = 0.0;
  for (std::size_t a = 0; a < point.probabilities.size(); ++a) {
    north += point.probabilities[a] * policy.actions[a].north;
    east += point.probabilities[a] * policy.actions[a].east;
  }
  point.agreement = std::hypot(north, east);
  constexpr double kNone = 1e-9;
  point.heading = point.agreement > kNone ? UnitNorthEast{.north = north / point.agreement, .east = east / point.agreement}
                                          : policy.actions[point.likeliest];
}

MapPoint point_of(const FrozenPolicy& policy, NorthEast place, const std::vector<float>& observation) {
  std::vector<float> logits(policy.actions.size());
  std::vector<float> probabilities(policy.actions.size());
  policy::find_logits(policy, observation, logits);
  policy::softmax(logits, probabilities);
  MapPoint point;
  point.place = place;
  point.probabilities.assign(probabilities.begin(), probabilities.end());
  point.likeliest = static_cast<std::size_t>(std::ranges::max_element(logits) - logits.begin());
  set_heading(policy, point);
  return point;
}

ActionMap map_of(const FrozenPolicy& policy, std::size_t per_side, const std::function<std::vector<float>(NorthEast)>& observe_at) {
  ActionMap map;
  for (const NorthEast place : cell_centres(policy.area_size, per_side)) map.push_back(point_of(policy, place, observe_at(place)));
  return map;
}

bool is_of_the_past(policy::Feature feature) {
  const Subject subject = subject_of(feature);
  return subject == Subject::kMoved || subject == Subject::kHeard;
}

}  // namespace

std::vector<NorthEast> cell_centres(NorthEast area_size, std::size_t per_side) {
  const auto along = [per_side](Meters side, std::size_t i) {
    return side * ((static_cast<double>(i) + 0.5) / static_cast<double>(per_side));
  };
  std::vector<NorthEast> centres;
  for (std::size_t i = 0; i < per_side * per_side; ++i)
    centres.push_back({along(area_size.north, i / per_side), along(area_size.east, i % per_side)});
  return centres;
}

ActionMap after_a_first_measurement(const FrozenPolicy& policy, const policy::OceanTables& tables, std::size_t per_side,
                                    const std::function<policy::Reception(NorthEast)>& reception_at) {
  const auto memory = std::make_unique<SearchMemory>();
  return map_of(policy, per_side, [&](NorthEast place) {
    memory->start(policy.observation, tables, place, reception_at(place));
    std::vector<float> observation(policy.observation.spec.size());
    policy::observe(*memory, policy.observation, observation);
    return observation;
  });
}

ActionMap standing_elsewhere(const FrozenPolicy& policy, const policy::OceanTables& tables, std::size_t per_side,
                             const SearchMemory& memory) {
  const auto moved = std::make_unique<SearchMemory>();
  return map_of(policy, per_side, [&](NorthEast place) {
    *moved = memory;
    moved->remember(policy.observation, tables, place, kNothingLearnt);
    std::vector<float> observation(policy.observation.spec.size());
    for (std::size_t i = 0; i < observation.size(); ++i) {
      const policy::ObservationElement& element = policy.observation.spec[i];
      observation[i] = policy::scaled(element, (is_of_the_past(element.feature) ? memory : *moved).raw(policy.observation, element));
    }
    return observation;
  });
}

}  // namespace earshot::explain
