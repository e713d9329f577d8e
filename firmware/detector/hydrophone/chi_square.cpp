#include "firmware/detector/hydrophone/chi_square.hpp"

#include "firmware/core/math.hpp"

namespace earshot::detector {

double chi_square_over_mean(double degrees_of_freedom, double normal_quantile) {
  const double variance = 2.0 / (9.0 * degrees_of_freedom);
  const double root = 1.0 - variance + normal_quantile * sqrt(variance);
  return root > 0.0 ? root * root * root : 0.0;
}

}  // namespace earshot::detector
