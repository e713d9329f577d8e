#pragma once

#include <cstddef>
#include <span>

#include "firmware/guidance/sweep.hpp"

namespace earshot::guidance {

/// What a search falls back to while its belief explains nothing that it hears, or it has heard nothing for long: a sweep of the area.
class Fallback {
 public:
  /// A new search begins.
  void start() { is_sweeping_ = false; }
  /// The action to take in place of `wanted`: as long as it is called for, that of a sweep, which begins where the vehicle is then.
  /// @param calls_for_sweep  whether what was heard so far does
  /// @param position      of the vehicle, finite
  /// @param actions       the directions of a step, at least one
  /// Oracle: Fallback.*
  [[nodiscard]] std::size_t choose(bool calls_for_sweep, std::size_t wanted, const SweepPlan& plan, NorthEast position,
                                   std::span<const UnitNorthEast> actions);
  [[nodiscard]] bool is_sweeping() const { return is_sweeping_; }

 private:
  bool is_sweeping_ = false;
  Sweep sweep_;
};

}  // namespace earshot::guidance
