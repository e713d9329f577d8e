#pragma once

#include <cstdint>
#include <functional>
#include <span>

#include "policy/evaluate/evaluation.hpp"
#include "policy/evaluate/interval.hpp"

namespace earshot::evaluate {

/// Intervals of what a table says about many searches; that of the share found is exact (interval.hpp).
struct Intervals {
  Interval restricted_mean_steps;  ///< of TimeToFind
  Interval mean_reward;
  Interval median_reward;
  Interval path_over_straight;  ///< NaN when fewer than one resample in two has a search that found a source
};

/// Percentile bootstrap: 1000 resamples of as many searches, drawn with replacement, the same for the same seed.
/// @param max_steps  N of the searches
/// @param between    called before each resample; what it throws ends the work: a resample of a million searches takes 30 ms
/// Source: Efron and Tibshirani, An Introduction to the Bootstrap (1993), ch. 13.   Oracle: Bootstrap.*
[[nodiscard]] Intervals bootstrap(std::span<const Flight> flights, std::uint32_t max_steps, std::uint64_t seed,
                                  const std::function<void()>& between = {});

}  // namespace earshot::evaluate
