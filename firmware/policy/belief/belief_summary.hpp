#pragma once

#include <span>

#include "firmware/messages/belief_summary.hpp"
#include "firmware/policy/belief/belief_model.hpp"

namespace earshot::policy {

/// Where the source is likeliest, its mean place and how far the belief spreads about it.
/// @param probabilities  of the cells of the model's grid, [north x east]
[[nodiscard]] messages::BeliefSummary summary_of(const BeliefModel& model, std::span<const float> probabilities);

}  // namespace earshot::policy
