#include "sim/sonar/grid_check.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "sim/pe/absorber.hpp"
#include "sim/pe/depth_grid.hpp"
#include "sim/pe/grid_choice.hpp"

namespace earshot::sonar {
namespace {

double absorber_wavelengths(const ocean::Section& section, Hertz frequency, Meters max_range, const pe::Options& options) {
  if (options.absorber_wavelengths) return *options.absorber_wavelengths;
  const double fastest =
      std::ranges::max(section.sediment, {}, [](const ocean::SedimentStation& station) { return station.layers.back().sound_speed; })
          .layers.back()
          .sound_speed.value;
  return pe::choose_absorber(section, frequency, max_range, {}).thickness_m() * frequency.value / fastest * (1.0 - 1e-9);
}

/// The solver's own steps made explicit: several rows of the result to a range step, or several steps to a row.
pe::Options explicit_grid(const ocean::Section& section, const RadialPlan& plan) {
  const Meters max_range = plan.max_range();
  const pe::GridChoice choice = pe::choose_grid(section, plan.band.high, max_range, plan.options.accuracy);
  const Meters longest = plan.options.range_step.value_or(choice.range_step);
  const double rows_per_step = std::floor(longest / plan.range_step + 1e-9);
  const double steps_per_row = std::ceil(plan.range_step / longest - 1e-9);
  pe::Options options = plan.options;
  options.depth_step = options.depth_step.value_or(choice.depth_step);
  options.range_step = rows_per_step >= 1.0 ? rows_per_step * plan.range_step : plan.range_step / steps_per_row;
  if (options.terms == 0) options.terms = choice.terms;
  options.absorber_wavelengths = absorber_wavelengths(section, plan.band.high, max_range, plan.options);
  return options;
}

std::vector<float> loss_db(const ocean::Section& section, const std::string& name, const RadialPlan& plan, const pe::Progress& progress) {
  std::vector<float> loss(plan.ranges * plan.depth_m.size());
  std::vector<float> sea_floor(plan.ranges);
  compute_radial(section, name, plan, {.transmission_loss_db = loss, .sea_floor_depth_m = sea_floor}, progress);
  return loss;
}

/// Three elements more, by which a wave is served that is three times closer to grazing.
constexpr double kThicker = 3.0;

RadialPlan finer(RadialPlan plan) {
  plan.range_step = plan.range_step / 2.0;
  plan.ranges *= 2;
  plan.options.depth_step = *plan.options.depth_step / 2.0;
  plan.options.range_step = *plan.options.range_step / 2.0;
  plan.options.absorber_wavelengths = kThicker * *plan.options.absorber_wavelengths;
  return plan;
}

}  // namespace

GridCheck check_grid(const ocean::Section& section, const std::string& name, const RadialPlan& plan, const pe::Progress& progress) {
  RadialPlan coarse = plan;
  coarse.band = {plan.band.high, plan.band.high};
  coarse.options = explicit_grid(section, plan);
  const auto half_of = [&progress](double start) {
    return [&progress, start](double fraction) {
      if (progress) progress(start + fraction * (start > 0.0 ? 0.8 : 0.2));  // the finer run takes four times as long
    };
  };
  const std::vector<float> before = loss_db(section, name, coarse, half_of(0.0));
  const std::vector<float> after = loss_db(section, name, finer(coarse), half_of(0.2));

  GridCheck check{.depth_step = *coarse.options.depth_step,
                  .range_step = *coarse.options.range_step,
                  .mean_db = 0.0,
                  .max_db = 0.0,
                  .range_of_max = {},
                  .depth_of_max = {}};
  const double wavelength_m = pe::sound_speed_bounds(section).lowest_mps / coarse.band.high.value;
  std::size_t count = 0;
  for (std::size_t i = 0; i < plan.ranges; ++i) {
    const Meters range = static_cast<double>(i + 1) * plan.range_step;
    for (std::size_t j = 0; j < plan.depth_m.size() && range.value > wavelength_m; ++j) {
      const std::size_t depths = plan.depth_m.size();
      const double change = std::abs(static_cast<double>(after[(2 * i + 1) * depths + j]) - static_cast<double>(before[i * depths + j]));
      if (!std::isfinite(change)) continue;
      check.mean_db += change;
      ++count;
      if (change > check.max_db) {
        check.max_db = change;
        check.range_of_max = range;
        check.depth_of_max = Meters{plan.depth_m[j]};
      }
    }
  }
  check.mean_db /= static_cast<double>(std::max<std::size_t>(1, count));
  return check;
}

}  // namespace earshot::sonar
