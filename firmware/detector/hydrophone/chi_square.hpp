#pragma once

namespace earshot::detector {

/// Quantile of a chi-square variable over its mean, by Wilson and Hilferty.
///
///   q = (1 - 2 / (9 n) + z sqrt(2 / (9 n)))^3
///
/// @param degrees_of_freedom  n, at least 1
/// @param normal_quantile     z of the same probability; zero for the median
/// Error: below 0.7 % from 10 degrees of freedom on and |z| up to 3.1.
/// Source: Wilson & Hilferty 1931, Proc. Natl. Acad. Sci. 17.   Oracle: ChiSquare.HasTheQuantilesThatScipyHas
[[nodiscard]] double chi_square_over_mean(double degrees_of_freedom, double normal_quantile);

}  // namespace earshot::detector
