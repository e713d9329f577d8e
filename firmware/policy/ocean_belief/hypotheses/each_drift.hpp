#pragma once

#include <cstddef>

#include "firmware/policy/ocean_belief/hypotheses/hypothesis_block.hpp"

namespace earshot::policy {

/// Calls `visit` with every drift in a block, and with the hypotheses that have it.
template <class Visit>
void for_each_drift(const HypothesisBlock& block, Visit visit) {
  Lanes visited{};
  for (std::size_t first = 0; first < kLanes; ++first) {
    if (visited[first]) continue;
    const Drift drift = block.hypothesis(first).drift;
    Lanes alike;
    for (std::size_t l = 0; l < kLanes; ++l) {
      alike[l] = block.hypothesis(l).drift == drift;
      visited[l] = visited[l] || alike[l];
    }
    visit(drift, alike);
  }
}

}  // namespace earshot::policy
