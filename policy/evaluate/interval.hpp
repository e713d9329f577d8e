#pragma once

#include <cstddef>

namespace earshot::evaluate {

/// A 95 % confidence interval.
struct Interval {
  double low = 0.0;
  double high = 0.0;
};

/// So many searches of so many found the source. found <= searches, searches >= 1.
struct FoundCount {
  std::size_t found;
  std::size_t searches;
};

/// Exact interval of the chance of finding (Clopper and Pearson): the chances with which so many finds or more, and so many or fewer, both
/// have a probability of 2.5 % or more. It holds the truth 95 times in a hundred or more often, however few the searches are, also where
/// all or none found; resampling them would say then that the chance is certain.
///
///   low = I^-1(0.025; k, n - k + 1), 0 for k = 0;   high = I^-1(0.975; k + 1, n - k), 1 for k = n;   I^-1 the inverse incomplete beta
///   function
///
/// Source: Clopper and Pearson, Biometrika 26 (1934) 404.   Oracle: ExactInterval.*
[[nodiscard]] Interval exact_interval(FoundCount count);

}  // namespace earshot::evaluate
