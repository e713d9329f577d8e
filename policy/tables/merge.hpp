#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "policy/tables/ocean_curve.hpp"

namespace earshot::tables {

/// What is fainter is not measured, however faint: 10 dB below the usual detection threshold.
inline constexpr double kAudible_db = 0.0;

/// Root mean square difference of two curves over the ranges where one of them is audible, what is fainter counted as kAudible_db; 0 where
/// neither is anywhere.
/// Oracle: Merge.*
[[nodiscard]] double difference_db(std::span<const double> a, std::span<const double> b);

struct Merged {
  std::vector<OceanCurve> curves;
  double most_difference_db = 0.0;  ///< of a curve that was given from the one that now stands for it
};

/// Puts curves together, the two that cost least each time, until at most so many are left.
///
///   cost = w_a w_b / (w_a + w_b) d^2                 (Ward: what it adds to the weighted sum of squared differences)
///
/// w: weights, d: difference_db. The one curve stands at their weighted mean in dB, has the sum of their weights, and the name and depths
/// of the heavier, of two equal ones the former. Of equal costs the first pair is taken: the same curves give the same result.
/// Source: Ward, J. Am. Stat. Assoc. 58 (1963), 236-244.
/// @param at_most  >= 1
[[nodiscard]] Merged merge(const std::vector<OceanCurve>& curves, std::size_t at_most);

}  // namespace earshot::tables
