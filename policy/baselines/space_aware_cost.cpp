#include "policy/baselines/space_aware_cost.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace earshot::baselines {
namespace {

/// log2 of the places that a step clears.
constexpr double kBitsOfAStrip = 1.0;

/// Of one outcome, over all places.
struct Sums {
  double probability = 0.0;
  double distance_steps = 0.0;  ///< weighed by it
  double p_log_p = 0.0;
};

}  // namespace

double space_aware_cost(double distance_steps, double entropy_bits) {
  const double of_strips_bits = std::max(0.0, entropy_bits - kBitsOfAStrip);
  return std::log2(distance_steps + std::exp2(of_strips_bits - 1.0) - 0.5);
}

double expected_space_aware_cost(std::span<const float> joint, std::span<const float> distance_steps) {
  const std::size_t outcomes = joint.size() / distance_steps.size();
  std::vector<Sums> sums(outcomes);
  for (std::size_t place = 0; place < distance_steps.size(); ++place) {
    for (std::size_t z = 0; z < outcomes; ++z) {
      const auto p = static_cast<double>(joint[place * outcomes + z]);
      if (!(p > 0.0)) continue;
      sums[z].probability += p;
      sums[z].distance_steps += p * static_cast<double>(distance_steps[place]);
      sums[z].p_log_p += p * std::log2(p);
    }
  }
  double expected = 0.0;
  for (const Sums& z : sums) {
    if (!(z.probability > 0.0)) continue;
    const double entropy_bits =
        std::max(0.0, std::log2(z.probability) - z.p_log_p / z.probability);  // of p / P(z); rounding alone is below 0
    expected += z.probability * space_aware_cost(z.distance_steps / z.probability, entropy_bits);
  }
  return expected;
}

}  // namespace earshot::baselines
