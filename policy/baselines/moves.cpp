#include "policy/baselines/moves.hpp"
#include "sim/search/reward/step_reward.hpp"

#include <limits>

namespace earshot::baselines {
namespace {

/// The action of the least cost; the first of equals.
template <class Cost>
std::size_t cheapest(const PriorKnowledge& prior, NorthEast position, Cost cost) {
  std::size_t best = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t action = 0; action < prior.actions.size(); ++action) {
    const double c = cost(end_of(prior, position, action));
    if (c < least) {
      least = c;
      best = action;
    }
  }
  return best;
}

}  // namespace

NorthEast end_of(const PriorKnowledge& prior, NorthEast position, std::size_t action) {
  return position + prior.settings.step_length * prior.actions[action];
}

double border_cost(const search::SearchSettings& settings, NorthEast position) {
  return -search::step_reward(settings, position, settings.detection_threshold);
}

std::size_t straight_toward(const PriorKnowledge& prior, NorthEast position, NorthEast place) {
  return cheapest(prior, position, [place](NorthEast end) { return range_between(end, place).value; });
}

std::size_t warily_toward(const PriorKnowledge& prior, NorthEast position, NorthEast place) {
  return cheapest(prior, position,
                  [&](NorthEast end) { return range_between(end, place) / prior.settings.step_length + border_cost(prior.settings, end); });
}

}  // namespace earshot::baselines
