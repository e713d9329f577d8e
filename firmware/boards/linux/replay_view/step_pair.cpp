#include "firmware/boards/linux/replay_view/step_pair.hpp"

#include <algorithm>
#include <map>

namespace earshot::replay_view {

bool StepPair::is_same() const {
  return then && now && then->utime == now->utime && then->waypoint_north_m == now->waypoint_north_m &&
         then->waypoint_east_m == now->waypoint_east_m;
}

std::vector<StepPair> paired(std::span<const decision_t> then, std::span<const decision_t> now) {
  std::map<std::int32_t, StepPair> by_step;
  for (const decision_t& decision : then) by_step[decision.step].then = decision;
  for (const decision_t& decision : now) by_step[decision.step].now = decision;
  std::vector<StepPair> pairs;
  for (auto& [step, pair] : by_step) {
    pair.step = step;
    if (step >= 0) pairs.push_back(pair);
  }
  return pairs;
}

std::span<const StepPair> from(std::uint32_t step, std::span<const StepPair> pairs) {
  const auto first = std::ranges::find_if(pairs, [step](const StepPair& pair) { return static_cast<std::uint32_t>(pair.step) >= step; });
  return {first, pairs.end()};
}

const StepPair* parting(std::span<const StepPair> pairs) {
  const auto found = std::ranges::find_if(pairs, [](const StepPair& pair) { return !pair.is_same(); });
  return found == pairs.end() ? nullptr : &*found;
}

}  // namespace earshot::replay_view
