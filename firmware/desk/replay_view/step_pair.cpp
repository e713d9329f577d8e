#include "firmware/desk/replay_view/step_pair.hpp"

#include <algorithm>
#include <limits>
#include <map>

namespace earshot::replay_view {

bool StepPair::is_same() const {
  return then && now && then->time == now->time && then->waypoint == now->waypoint;
}

std::vector<StepPair> paired(std::span<const messages::Decision> then, std::span<const messages::Decision> now) {
  constexpr auto kMostSteps =
      static_cast<std::uint32_t>(std::numeric_limits<std::int32_t>::max());  // more is what others read as below zero
  std::map<std::uint32_t, StepPair> by_step;
  for (const messages::Decision& decision : then) by_step[decision.step].then = decision;
  for (const messages::Decision& decision : now) by_step[decision.step].now = decision;
  std::vector<StepPair> pairs;
  for (auto& [step, pair] : by_step) {
    pair.step = step;
    if (step <= kMostSteps) pairs.push_back(pair);
  }
  return pairs;
}

std::span<const StepPair> from(std::uint32_t step, std::span<const StepPair> pairs) {
  const auto first = std::ranges::find_if(pairs, [step](const StepPair& pair) { return pair.step >= step; });
  return {first, pairs.end()};
}

const StepPair* parting(std::span<const StepPair> pairs) {
  const auto found = std::ranges::find_if(pairs, [](const StepPair& pair) { return !pair.is_same(); });
  return found == pairs.end() ? nullptr : &*found;
}

}  // namespace earshot::replay_view
