#include "firmware/policy/likelihood/bearing_likelihood.hpp"

#include "firmware/core/math.hpp"

namespace earshot::policy {
namespace {

constexpr double kPi = 0x1.921fb54442d18p+1;
constexpr double kRootTwoPi = 2.50662827463100050242;

/// 2 pi times the density of the normal distribution wrapped round the circle. Turns that are left out hold less than 1e-5 of it.
/// @param spread  > 0 and at most pi
double wrapped_normal(Radians off, double spread) {
  const double nearest = wrap_to_pi(off).value;
  const int turns = static_cast<int>(spread * (2.0 / kPi) + 0.75);
  double sum = 0.0;
  for (int turn = -turns; turn <= turns; ++turn) {
    const double z = (nearest + 2.0 * kPi * turn) / spread;
    sum += exp(-0.5 * z * z);
  }
  return sum * (kRootTwoPi / spread);
}

}  // namespace

BearingLikelihood::BearingLikelihood(const messages::Bearing& bearing, Meters cell, float outlier_share)
    : direction_(bearing.direction.value),
      mirrored_(bearing.mirror_axis ? 2.0 * bearing.mirror_axis->value - bearing.direction.value : bearing.direction.value),
      variance_(bearing.deviation.value * bearing.deviation.value),
      smear_(cell.value * cell.value / 12.0),
      regular_(1.0 - double{outlier_share}),
      outlier_(double{outlier_share}) {}

float BearingLikelihood::at(NorthEast way) const {
  const double north = way.north.value;
  const double east = way.east.value;
  const double smeared = variance_ * (north * north + east * east) + smear_;
  const double whole = kPi * kPi * (north * north + east * east);
  const double spread = smeared < whole ? sqrt(smeared / (north * north + east * east)) : kPi;
  const double angle = bearing_of(north, east).value;
  const double straight = wrapped_normal(Radians{angle - direction_}, spread);
  const double likelihood = mirrored_ == direction_ ? straight : 0.5 * (straight + wrapped_normal(Radians{angle - mirrored_}, spread));
  return static_cast<float>(regular_ * likelihood + outlier_);
}

}  // namespace earshot::policy
