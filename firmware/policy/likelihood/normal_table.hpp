#pragma once

#include <span>

namespace earshot::policy {

// The normal distribution by table: computed by the compiler, so that every machine has the same bits, and cheap enough for every range of
// a belief. Numbers beyond eight standard deviations are taken for eight.

/// Puts the density of the standard normal distribution in the place of every number.
/// Error: at most 5e-5.   Oracle: NormalDensity.IsThatOfTheClosedForm
void to_normal_density(std::span<float> numbers);

/// Puts the probability that a standard normal number is at most x in the place of every number x.
/// Error: at most 5e-5.   Oracle: NormalCumulative.IsThatOfTheClosedForm
void to_normal_cumulative(std::span<float> numbers);

}  // namespace earshot::policy
