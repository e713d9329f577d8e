#include "policy/evaluate/interval.hpp"

#include <boost/math/distributions/binomial.hpp>
#include <cassert>

namespace earshot::evaluate {

Interval exact_interval(FoundCount count) {
  assert(count.searches >= 1 && count.found <= count.searches);
  using Binomial = boost::math::binomial_distribution<double>;
  constexpr double kOneSide = 0.025;
  const auto trials = static_cast<double>(count.searches);
  const auto successes = static_cast<double>(count.found);
  return {Binomial::find_lower_bound_on_p(trials, successes, kOneSide), Binomial::find_upper_bound_on_p(trials, successes, kOneSide)};
}

}  // namespace earshot::evaluate
