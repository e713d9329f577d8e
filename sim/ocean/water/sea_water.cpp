#include "sim/ocean/water/sea_water.hpp"

#include <array>
#include <cmath>
#include <cstddef>

namespace earshot::ocean {
namespace {

/// a[0] + a[1] x + a[2] x^2 + ...
template <std::size_t kTerms>
double polynomial(const std::array<double, kTerms>& a, double x) {
  double sum = 0.0;
  for (std::size_t i = kTerms; i > 0; --i) sum = sum * x + a[i - 1];
  return sum;
}

double squared(double x) {
  return x * x;
}

}  // namespace

MetersPerSecond sound_speed_mackenzie(const SeaWater& water, Meters depth) {
  const double t = water.temperature_c;
  const double s = water.salinity_psu - 35.0;
  const double d = depth.value;
  return MetersPerSecond{polynomial<4>({1448.96, 4.591, -5.304e-2, 2.374e-4}, t) + 1.340 * s + 1.630e-2 * d + 1.675e-7 * d * d -
                         1.025e-2 * t * s - 7.139e-13 * t * d * d * d};
}

MetersPerSecond sound_speed_unesco(const SeaWater& water, double pressure_dbar) {
  const double t = water.temperature_c;
  const double s = water.salinity_psu;
  const double p = pressure_dbar / 10.0;  // bar, as the paper's
  const double pure = polynomial<4>({polynomial<6>({1402.388, 5.03830, -5.81090e-2, 3.3432e-4, -1.47797e-6, 3.1419e-9}, t),
                                     polynomial<5>({0.153563, 6.8999e-4, -8.1829e-6, 1.3632e-7, -6.1260e-10}, t),
                                     polynomial<5>({3.1260e-5, -1.7111e-6, 2.5986e-8, -2.5353e-10, 1.0415e-12}, t),
                                     polynomial<3>({-9.7729e-9, 3.8513e-10, -2.3654e-12}, t)},
                                    p);
  const double a = polynomial<4>(
      {polynomial<5>({1.389, -1.262e-2, 7.166e-5, 2.008e-6, -3.21e-8}, t),
       polynomial<5>({9.4742e-5, -1.2583e-5, -6.4928e-8, 1.0515e-8, -2.0142e-10}, t),
       polynomial<4>({-3.9064e-7, 9.1061e-9, -1.6009e-10, 7.994e-12}, t), polynomial<3>({1.100e-10, 6.651e-12, -3.391e-13}, t)},
      p);
  const double b = polynomial<2>({polynomial<2>({-1.922e-2, -4.42e-5}, t), polynomial<2>({7.3637e-5, 1.7950e-7}, t)}, p);
  const double d = polynomial<2>({1.727e-3, -7.9836e-6}, p);
  return MetersPerSecond{pure + a * s + b * s * std::sqrt(s) + d * s * s};
}

double pressure_dbar(Meters depth, Radians latitude) {
  const double c1 = (5.92 + 5.25 * squared(std::sin(latitude.value))) * 1e-3;
  const double c2 = 2.21e-6;
  return (1.0 - c1 - std::sqrt(squared(1.0 - c1) - 4.0 * c2 * depth.value)) / (2.0 * c2);
}

MetersPerSecond sound_speed_of(const SeaWater& water, Meters depth, Radians latitude, SoundSpeedFormula formula) {
  if (formula == SoundSpeedFormula::kMackenzie) return sound_speed_mackenzie(water, depth);
  return sound_speed_unesco(water, pressure_dbar(depth, latitude));
}

double absorption_db_per_km(const SeaWater& water, Meters depth, Hertz frequency) {
  const double t = water.temperature_c;
  const double s = water.salinity_psu;
  const double d = depth.value;
  const double kelvin = t + 273.0;  // the paper's own offset
  const double f2 = squared(frequency.value / 1000.0);
  const double c = 1412.0 + 3.21 * t + 1.19 * s + 0.0167 * d;

  const double boric_strength = 8.86 / c * std::pow(10.0, 0.78 * water.acidity_ph_nbs - 5.0);
  const double boric_khz = 2.8 * std::sqrt(s / 35.0) * std::pow(10.0, 4.0 - 1245.0 / kelvin);
  const double sulphate_strength = 21.44 * s / c * (1.0 + 0.025 * t) * polynomial<3>({1.0, -1.37e-4, 6.2e-9}, d);
  const double sulphate_khz = 8.17 * std::pow(10.0, 8.0 - 1990.0 / kelvin) / (1.0 + 0.0018 * (s - 35.0));
  const double pure_strength =
      (t <= 20.0 ? polynomial<4>({4.937e-4, -2.59e-5, 9.11e-7, -1.50e-8}, t) : polynomial<4>({3.964e-4, -1.146e-5, 1.45e-7, -6.5e-10}, t)) *
      polynomial<3>({1.0, -3.83e-5, 4.9e-10}, d);
  return boric_strength * boric_khz * f2 / (squared(boric_khz) + f2) +
         sulphate_strength * sulphate_khz * f2 / (squared(sulphate_khz) + f2) + pure_strength * f2;
}

}  // namespace earshot::ocean
