#include "firmware/guidance/fallback.hpp"

namespace earshot::guidance {

std::size_t Fallback::choose(bool calls_for_sweep, std::size_t wanted, const SweepPlan& plan, NorthEast position,
                             std::span<const UnitNorthEast> actions) {
  if (calls_for_sweep && !is_sweeping_) sweep_ = Sweep(plan, position);
  is_sweeping_ = calls_for_sweep;
  return is_sweeping_ ? sweep_.next(position, actions).action : wanted;
}

}  // namespace earshot::guidance
