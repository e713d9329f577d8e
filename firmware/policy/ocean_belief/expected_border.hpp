#pragma once

#include <span>

#include "firmware/core/geometry.hpp"
#include "firmware/policy/action_values/action_values.hpp"
#include "firmware/policy/belief/belief_model.hpp"

namespace earshot::policy {

/// Where in the area the vehicle may be.
struct PossiblePlace {
  NorthEast vehicle;  ///< from the area's south-west corner
  float share;        ///< its probability
};

/// Puts what is expected of the border in the place of what one place of the vehicle says, where a current that navigation does not see may
/// have carried it: in the action values and in their regrets.
///
///   B_a = sum over the places of share * min(B(vehicle + step_a), 3)
///
/// No end of a step counts as deeper than 3 widths of the border: further out the search is over.
/// @param action_values  [actions]: in regret what the action costs above another, whatever that is
/// Oracle: ExpectedBorder.*
void expect_border(const BeliefModel& model, std::span<const PossiblePlace> places, std::span<ActionValues> action_values);

}  // namespace earshot::policy
