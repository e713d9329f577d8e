#include "sim/sonar/fan.hpp"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <numeric>
#include <span>

#include "sim/ocean/section_along.hpp"
#include "sim/parallel/ordered_tasks.hpp"
#include "sim/pe/grid_choice.hpp"

namespace earshot::sonar {
namespace {

/// How far several marches are in all, on threads of their own.
class SharedProgress {
 public:
  SharedProgress(std::size_t marches, const pe::Progress& progress) : shares_(marches, 0.0), progress_(progress) {}

  void report(std::size_t march, double share) {
    if (!progress_) return;
    const std::scoped_lock lock(mutex_);
    shares_[march] = share;
    progress_(std::accumulate(shares_.begin(), shares_.end(), 0.0) / static_cast<double>(shares_.size()));
  }

 private:
  std::mutex mutex_;
  std::vector<double> shares_;  // of each march
  const pe::Progress& progress_;
};

}  // namespace

Meters deepest_sea_floor(const ocean::Environment& environment, NorthEast centre, std::size_t bearings, Meters max_range) {
  Meters deepest;
  for (std::size_t j = 0; j < (differs_with_place(environment) ? bearings : 1); ++j)
    deepest =
        std::max(deepest, deepest_sea_floor(ocean::section_along(environment, centre, bearing_of(j, bearings), max_range), max_range));
  return deepest;
}

std::optional<ocean::UnmeasuredWater> unmeasured_water(const ocean::Environment& environment, NorthEast centre, std::size_t bearings,
                                                       Meters max_range) {
  std::optional<ocean::UnmeasuredWater> thickest;
  for (std::size_t j = 0; j < (differs_with_place(environment) ? bearings : 1); ++j) {
    const auto here = ocean::section_along(environment, centre, bearing_of(j, bearings), max_range).unmeasured;
    if (here && (!thickest || here->thickness() > thickest->thickness())) thickest = here;
  }
  return thickest;
}

std::vector<double> bearings_deg(const Fan& fan) {
  std::vector<double> bearing_deg;
  for (std::size_t j = 0; j < fan.bearings; ++j) bearing_deg.push_back(360.0 * static_cast<double>(j) / static_cast<double>(fan.bearings));
  return bearing_deg;
}

std::vector<double> ranges_m(const Fan& fan) {
  std::vector<double> range_m;
  for (std::size_t i = 0; i < fan.ranges; ++i) range_m.push_back(static_cast<double>(i + 1) * fan.range_step.value);
  return range_m;
}

std::optional<pe::MarchGrid> grid_of(const Fan& fan) {
  std::optional<pe::MarchGrid> all;
  for (const std::optional<pe::MarchGrid>& grid : fan.grid) {
    if (!grid) continue;
    if (!all) all = grid;
    all->depth_step = std::min(all->depth_step, grid->depth_step);
    all->range_step = std::min(all->range_step, grid->range_step);
    all->terms = std::max(all->terms, grid->terms);
    all->predicted_error_db = std::max(all->predicted_error_db, grid->predicted_error_db);  // NaN of all where the caller chose
  }
  return all;
}

std::optional<std::string> doubt_of(const Fan& fan, Decibels accuracy) {
  const std::optional<pe::MarchGrid> grid = grid_of(fan);
  return grid ? pe::doubt_of(grid->predicted_error_db, accuracy) : std::nullopt;
}

bool has_sound(const Fan& fan) {
  return !std::ranges::all_of(fan.transmission_loss_db, [](float loss_db) { return std::isnan(loss_db); });
}

Fan make_fan(NorthEast centre, const FanPlan& plan) {
  const RadialPlan& radial = plan.radial;
  return {.centre = centre,
          .bearings = plan.bearings,
          .ranges = radial.ranges,
          .range_step = radial.range_step,
          .depth_m = radial.depth_m,
          .transmission_loss_db = std::vector<float>(plan.bearings * radial.ranges * radial.depth_m.size()),
          .sea_floor_depth_m = std::vector<float>(plan.bearings * radial.ranges),
          .grid = std::vector<std::optional<pe::MarchGrid>>(plan.bearings)};
}

void fill_bearing(const ocean::Environment& environment, const FanPlan& plan, std::size_t bearing, Fan& fan, const pe::Progress& progress) {
  const std::size_t radial_size = fan.ranges * fan.depth_m.size();
  fan.grid[bearing] =
      compute_radial(ocean::section_along(environment, fan.centre, bearing_of(bearing, plan.bearings), plan.radial.max_range()),
                     environment.name, plan.radial,
                     {.transmission_loss_db = std::span(fan.transmission_loss_db).subspan(bearing * radial_size, radial_size),
                      .sea_floor_depth_m = std::span(fan.sea_floor_depth_m).subspan(bearing * fan.ranges, fan.ranges)},
                     progress);
}

void repeat_first_bearing(Fan& fan) {
  const auto radial_size = static_cast<std::ptrdiff_t>(fan.ranges * fan.depth_m.size());
  const auto ranges = static_cast<std::ptrdiff_t>(fan.ranges);
  for (std::ptrdiff_t j = 1; j < static_cast<std::ptrdiff_t>(fan.bearings); ++j) {
    std::copy_n(fan.transmission_loss_db.begin(), radial_size, fan.transmission_loss_db.begin() + j * radial_size);
    std::copy_n(fan.sea_floor_depth_m.begin(), ranges, fan.sea_floor_depth_m.begin() + j * ranges);
  }
  for (std::optional<pe::MarchGrid>& grid : fan.grid) grid = fan.grid.front();
}

Fan compute_fan(const ocean::Environment& environment, NorthEast centre, const FanPlan& plan, std::size_t threads,
                const pe::Progress& progress) {
  Fan fan = make_fan(centre, plan);
  const std::size_t marches = differs_with_place(environment) ? plan.bearings : 1;
  SharedProgress shared(marches, progress);
  parallel::run_in_order(
      {.groups = marches, .tasks_per_group = 1, .threads = threads, .window = marches},
      [&](std::size_t bearing) {
        fill_bearing(environment, plan, bearing, fan, [&shared, bearing](double share) { shared.report(bearing, share); });
        shared.report(bearing, 1.0);  // also where there is nothing to march through
      },
      [](std::size_t) {});
  if (marches == 1) repeat_first_bearing(fan);
  return fan;
}

}  // namespace earshot::sonar
