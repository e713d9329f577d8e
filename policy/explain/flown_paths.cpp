#include "policy/explain/flown_paths.hpp"

#include <algorithm>
#include <memory>

#include "policy/explain/action_map.hpp"
#include "policy/explain/wording.hpp"

namespace earshot::explain {
namespace {

using policy::FrozenPolicy;
using policy::SearchMemory;

std::size_t likeliest_action(const FrozenPolicy& policy, const SearchMemory& memory) {
  std::vector<float> observation(policy.observation.spec.size());
  std::vector<float> logits(policy.actions.size());
  policy::observe(memory, policy.observation, observation);
  policy::find_logits(policy, observation, logits);
  return static_cast<std::size_t>(std::ranges::max_element(logits) - logits.begin());
}

FlownPath flown_from(const FrozenPolicy& policy, const policy::OceanTables& tables, NorthEast start, NorthEast source,
                     std::size_t max_steps, const std::function<policy::Reception(NorthEast)>& reception_at) {
  const Rectangle area{{}, policy.area_size};
  const auto memory = std::make_unique<SearchMemory>();
  memory->start(policy.observation, tables, start, reception_at(start));
  FlownPath path{.places = {start}};
  for (NorthEast place = start; range_between(place, source) > policy.step_length; path.places.push_back(place)) {
    if (!area.contains(place)) path.end = FlownPath::End::kLeft;
    if (path.end == FlownPath::End::kLeft || path.steps() == max_steps) return path;
    place = place + policy.step_length * policy.actions[likeliest_action(policy, *memory)];
    memory->remember(policy.observation, tables, place, reception_at(place));
  }
  path.end = FlownPath::End::kFound;
  return path;
}

}  // namespace

bool sees_place_alone(const FrozenPolicy& policy) {
  return std::ranges::all_of(policy.observation.spec,
                             [](const policy::ObservationElement& element) { return subject_of(element.feature) == Subject::kPlace; });
}

std::vector<FlownPath> flown_from_all_over(const FrozenPolicy& policy, const policy::OceanTables& tables, NorthEast source,
                                           const PathSettings& settings, const std::function<policy::Reception(NorthEast)>& reception_at) {
  std::vector<FlownPath> paths;
  for (const NorthEast start : cell_centres(policy.area_size, settings.per_side))
    paths.push_back(flown_from(policy, tables, start, source, settings.max_steps, reception_at));
  return paths;
}

}  // namespace earshot::explain
