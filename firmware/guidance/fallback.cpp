#include "firmware/guidance/fallback.hpp"

namespace earshot::guidance {

std::size_t Fallback::choose(bool is_surprised, std::size_t wanted, const SweepPlan& plan, NorthEast position,
                             std::span<const UnitNorthEast> actions) {
  if (is_surprised && !is_sweeping_) {
    sweep_ = Sweep(plan, position);
    is_sweeping_ = true;
  }
  return is_sweeping_ ? sweep_.next(position, actions).action : wanted;
}

}  // namespace earshot::guidance
