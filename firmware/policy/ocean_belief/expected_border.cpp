#include "firmware/policy/ocean_belief/expected_border.hpp"

#include <algorithm>

namespace earshot::policy {
namespace {

constexpr double kDeepest = 3.0;

/// B(y): 0 inside, 1 at the edge, more beyond.
float border_depth(const BeliefModel& model, NorthEast place) {
  const auto beyond = [&model](Meters x, Meters size) { return std::max(model.border_width - x, x - (size - model.border_width)); };
  const Meters deepest = std::max(beyond(place.north, model.area_size.north), beyond(place.east, model.area_size.east));
  return static_cast<float>(std::clamp(deepest / model.border_width, 0.0, kDeepest));
}

}  // namespace

void expect_border(const BeliefModel& model, std::span<const PossiblePlace> places, std::span<ActionValues> action_values) {
  for (std::size_t a = 0; a < action_values.size(); ++a) {
    float expected = 0.0F;
    for (const PossiblePlace& place : places)
      expected += place.share * border_depth(model, place.vehicle + model.step_length * model.actions[a]);
    action_values[a].regret += model.costs.edge * (expected - action_values[a].border);
    action_values[a].border = expected;
  }
}

}  // namespace earshot::policy
