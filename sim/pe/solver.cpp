#include "sim/pe/solver.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

#include "sim/pe/depth_grid.hpp"
#include "sim/pe/depth_operator.hpp"
#include "sim/pe/rational.hpp"
#include "sim/pe/rational_operator.hpp"
#include "sim/pe/starter.hpp"

namespace earshot::pe {
namespace {

using Complex = std::complex<double>;

constexpr std::size_t kMostTerms = 12;  // beyond it the Pade system is ill conditioned in 80-bit arithmetic too

/// Below this many wavelengths every range gets a starting field of its own: the propagator, unitary on the real axis, would carry the
/// evanescent part of a nearer one for ever.
constexpr double kNearFieldWavelengths = 0.5;

struct Speeds {
  double slowest_mps;  ///< of water and sediment
  double mean_water_mps;
};

Speeds speeds(const ocean::Environment& environment) {
  constexpr int kSamples = 1000;
  Speeds result{.slowest_mps = environment.seabed.layers.front().sound_speed.value, .mean_water_mps = 0.0};
  for (const auto& layer : environment.seabed.layers) result.slowest_mps = std::min(result.slowest_mps, layer.sound_speed.value);
  for (int i = 0; i < kSamples; ++i) {
    const double c = ocean::sound_speed(environment.water, (i + 0.5) / kSamples * environment.seabed.depth).value;
    result.slowest_mps = std::min(result.slowest_mps, c);
    result.mean_water_mps += c / kSamples;
  }
  return result;
}

void check(const ocean::Environment& environment, const Options& options, std::span<const double> receiver_depth_m, Meters max_range) {
  const auto require = [](bool fine, const std::string& what) {
    if (!fine) throw std::invalid_argument(what);
  };
  const double sea_floor = environment.seabed.depth.value;
  require(options.terms >= 1 && options.terms <= kMostTerms, "terms must be from 1 to " + std::to_string(kMostTerms));
  require(!options.depth_step || options.depth_step->value > 0.0, "the depth step must be above 0 m");
  require(!options.range_step || options.range_step->value > 0.0, "the range step must be above 0 m");
  require(options.absorber_wavelengths > 0.0, "the absorber must be thicker than 0 wavelengths");
  require(max_range.value > 0.0 && std::isfinite(max_range.value), "the largest range must be above 0 m");
  for (const double depth : receiver_depth_m) {
    require(depth >= 0.0 && depth <= sea_floor,
            "receiver depth " + std::to_string(depth) + " m must be from 0 m to the sea floor at " + std::to_string(sea_floor) + " m");
  }
}

/// Two significant digits, rounded down, so that automatic ranges read well.
double round_number(double x) {
  const double unit = std::pow(10.0, std::floor(std::log10(x)) - 1.0);
  return std::floor(x / unit + 1e-9) * unit;
}

/// Everything about one solution that does not change along the range.
struct Plan {
  double k0_per_m;
  double near_field_m;  ///< up to here every range gets a starting field of its own
  Meters range_step;
  DepthGrid grid;
  DepthOperator x;
  Spectrum spectrum;
};

Plan make_plan(const ocean::Environment& environment, const Options& options) {
  const Hertz frequency = environment.source.frequency;
  const auto [slowest, mean] = speeds(environment);
  const double wavelength_m = slowest / frequency.value;
  Plan plan{.k0_per_m = 2.0 * std::numbers::pi * frequency.value / mean,
            .near_field_m = 0.0,
            .range_step = options.range_step.value_or(Meters{round_number(wavelength_m / 4.0)}),
            .grid = make_depth_grid(
                environment.water, environment.seabed, frequency,
                {.step = options.depth_step.value_or(Meters{wavelength_m / 16.0}), .absorber_wavelengths = options.absorber_wavelengths}),
            .x = {},
            .spectrum = {}};
  plan.near_field_m = std::max(plan.range_step.value, kNearFieldWavelengths * wavelength_m);
  plan.x = make_depth_operator(plan.grid, plan.k0_per_m);
  // The steepest wave that the water's grid holds under Numerov's mass weights has kz = sqrt(6) / step.
  plan.spectrum = {.lowest = -6.0 / std::pow(plan.k0_per_m * plan.grid.water_step_m, 2) - 1.0,
                   .highest = std::pow(mean / slowest, 2) - 0.99};
  return plan;
}

/// The delta function of a unit source, scaled so that the starter makes pressure times the square root of range of it.
std::vector<Complex> point_source(const Plan& plan, Meters depth) {
  std::vector<Complex> delta(plan.x.size());
  const DepthTap tap = tap_at(plan.grid, depth);
  const double scale = std::sqrt(2.0 * std::numbers::pi / plan.k0_per_m) / plan.grid.water_step_m;
  for (std::size_t i = 0; i < tap.weight.size(); ++i) {
    const std::size_t node = tap.first_node + i;  // node 0 is the surface and holds no pressure
    if (node > 0) delta[node - 1] += scale * tap.weight[i];
  }
  return delta;
}

Complex pressure_at(std::span<const Complex> p, const DepthTap& tap) {
  Complex sum = 0.0;
  for (std::size_t i = 0; i < tap.weight.size(); ++i) {
    const std::size_t node = tap.first_node + i;
    if (node > 0) sum += tap.weight[i] * p[node - 1];
  }
  return sum;
}

}  // namespace

Field solve(const ocean::Environment& environment, const Options& options, std::span<const double> receiver_depth_m, Meters max_range,
            const Progress& progress) {
  check(environment, options, receiver_depth_m, max_range);
  const Plan plan = make_plan(environment, options);
  const double dr = plan.range_step.value;
  Field field{.range_step = plan.range_step, .depth_m = {receiver_depth_m.begin(), receiver_depth_m.end()}, .pressure = {}};
  const auto rows = std::max<Eigen::Index>(1, static_cast<Eigen::Index>(std::floor(max_range.value / dr + 1e-9)));
  field.pressure.resize(rows, static_cast<Eigen::Index>(receiver_depth_m.size()));
  std::vector<DepthTap> taps;
  for (const double depth : receiver_depth_m) taps.push_back(tap_at(plan.grid, Meters{depth}));

  const std::vector<Complex> source = point_source(plan, environment.source.depth);
  std::vector<Complex> p;
  RationalOperator step(plan.x, propagator(plan.k0_per_m * dr, options.terms));
  for (Eigen::Index row = 0; row < rows; ++row) {
    const double range_m = static_cast<double>(row + 1) * dr;
    if (range_m - dr < plan.near_field_m) {
      p = source;
      RationalOperator(plan.x, starter(plan.k0_per_m * range_m, plan.spectrum)).apply(p);
    } else {
      step.apply(p);
    }
    for (std::size_t i = 0; i < taps.size(); ++i)
      field.pressure(row, static_cast<Eigen::Index>(i)) = pressure_at(p, taps[i]) / std::sqrt(range_m);
    if (progress && row % 64 == 0) progress(static_cast<double>(row) / static_cast<double>(rows));
  }
  if (progress) progress(1.0);
  return field;
}

}  // namespace earshot::pe
