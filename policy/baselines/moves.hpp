#pragma once

#include <cstddef>

#include "policy/baselines/searcher.hpp"

namespace earshot::baselines {

[[nodiscard]] NorthEast end_of(const PriorKnowledge& prior, NorthEast position, std::size_t action);

/// The border's penalty at a place, as a positive number; 0 inside.
[[nodiscard]] double border_cost(const search::SearchSettings& settings, NorthEast position);

/// The action that ends nearest to a place, heedless of the border; the first of equals.
[[nodiscard]] std::size_t straight_toward(const PriorKnowledge& prior, NorthEast position, NorthEast place);

/// The action that ends nearest to a place, where each step length of distance weighs as much as a point of border cost at the end.
[[nodiscard]] std::size_t warily_toward(const PriorKnowledge& prior, NorthEast position, NorthEast place);

}  // namespace earshot::baselines
