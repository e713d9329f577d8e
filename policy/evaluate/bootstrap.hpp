#pragma once

#include <cstdint>
#include <functional>
#include <span>

#include "policy/evaluate/evaluation.hpp"

namespace earshot::evaluate {

struct Interval {
  double low = 0.0;
  double high = 0.0;
};

/// 95 % confidence intervals of what a table says about many searches.
struct Intervals {
  Interval mean_reward;
  Interval median_reward;
  Interval found_fraction;
  Interval path_over_straight;  ///< NaN when fewer than one resample in two has a search that found a source
};

/// Percentile bootstrap: 1000 resamples of as many searches, drawn with replacement, the same for the same seed.
/// Source: Efron and Tibshirani, An Introduction to the Bootstrap (1993), ch. 13.   Oracle: Bootstrap.*
[[nodiscard]] Intervals bootstrap(std::span<const Flight> flights, std::uint64_t seed);

}  // namespace earshot::evaluate
