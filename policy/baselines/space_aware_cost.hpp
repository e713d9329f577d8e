#pragma once

#include <cstddef>
#include <span>

namespace earshot::baselines {

/// How much of a search is left, as space-aware infotaxis reckons it: the steps to the source, were its place known, and those that trying
/// all places would take.
///
///   J = log2(D + 2^(H' - 1) - 1/2),   H' = max(0, H - 1)
///
/// Of N strips, each as likely as another, H' is log2(N) and 2^(H' - 1) - 1/2 is (N - 1) / 2: the mean number that is tried in vain. A
/// strip is two places wide, those that a step clears, for it finds what lies within its own length on either side.
/// @param distance_steps  D, the mean distance to the source, >= 1: what is nearer is found
/// @param entropy_bits    H, Shannon's entropy of its place, >= 0; a place is as long and as wide as a step
/// @return >= 0; 0 where the source is surely a step away
/// Source: Loisy and Eloy, Proc. R. Soc. A 478 (2022) 20220118. Their searcher clears one place a step, so that H' is H, which takes up to
/// 8 % longer here (README.md); and has four directions, so that D is a Manhattan distance, where here it is that of the crow. Oracle:
/// SpaceAwareCost.*
[[nodiscard]] double space_aware_cost(double distance_steps, double entropy_bits);

/// What J is expected to be after a step.
///
///   E[J] = sum over the outcomes z of P(z) J(place | z);   nothing is left where the source is found, which is the rest of the probability
///
/// @param joint           [place x outcome], probability of a place together with what is then heard, where the source is not found; they
///                        add up to 1 at most
/// @param distance_steps  [place], >= 1, from the step's end
/// Oracle: SpaceAwareCost.*
[[nodiscard]] double expected_space_aware_cost(std::span<const float> joint, std::span<const float> distance_steps);

}  // namespace earshot::baselines
