#include "policy/tables/ocean_curve.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <stdexcept>
#include <utility>

#include "sim/parallel/ordered_tasks.hpp"
#include "sim/search/scenario/soundscape.hpp"
#include "sim/sonar/fan.hpp"
#include "sim/sonar/sonar_equation.hpp"
#include "sim/sonar/sonar_field.hpp"

namespace earshot::tables {
namespace {

constexpr Meters kFanStep{10.0};  // as sonar::compute_snr_curve has it

/// @param place  where in it; empty: everywhere
OceanCurve without_sound(const BelievedOcean& ocean, const std::string& place) {
  return {.name = ocean.environment.name,
          .detail = ocean.detail + place,
          .weight = 1.0,
          .sea_depth = ocean.environment.seabed.depth,
          .source_depth = ocean.environment.source.depth,
          .snr_db = {}};
}

std::vector<double> samples(const CurvePlan& plan, const std::function<double(Meters range)>& snr_db) {
  std::vector<double> result;
  for (std::size_t i = 0; i < plan.range_count; ++i) result.push_back(snr_db(static_cast<double>(i) * plan.range_step));
  return result;
}

OceanCurve curve_everywhere(const BelievedOcean& ocean, const CurvePlan& plan) {
  OceanCurve curve = without_sound(ocean, "");
  const sonar::SnrCurve snr = sonar::compute_snr_curve(ocean.environment, plan.vehicle_depth, plan.furthest());
  curve.snr_db = samples(plan, [&snr](Meters range) { return snr.at(range).value; });
  return curve;
}

std::string degrees(Radians bearing) {
  return std::to_string(std::lround(bearing.value * 180.0 / std::numbers::pi)) + " deg";
}

/// Along one bearing of a fan; nothing where there is no water on all of it.
std::vector<double> snr_along(const search::SnrFan& f, Radians bearing, const CurvePlan& plan) {
  bool is_heard = false;
  std::vector<double> snr_db = samples(plan, [&](Meters range) {
    const Meters away = std::max(range, f.fan.range_step);  // a place at the source has no bearing
    const NorthEast there{std::cos(bearing.value) * away, std::sin(bearing.value) * away};
    const double loss_db = f.fan.transmission_loss_at(f.fan.centre + there, 0);
    is_heard = is_heard || !std::isnan(loss_db);
    const Decibels loss = std::isnan(loss_db) ? sonar::kMaxTransmissionLoss : Decibels{loss_db};
    return sonar::signal_to_noise(f.source_level, loss, f.noise_level).value;
  });
  return is_heard ? snr_db : std::vector<double>{};
}

/// @param fans  around the positions of sources, each as likely as another
std::vector<OceanCurve> curves_of_fans(const BelievedOcean& ocean, std::span<const search::SnrFan> fans, const CurvePlan& plan) {
  std::vector<OceanCurve> curves;
  for (std::size_t i = 0; i < fans.size(); ++i) {
    const std::size_t bearings = std::min(plan.bearings, fans[i].fan.bearings);
    for (std::size_t j = 0; j < bearings; ++j) {
      const Radians bearing = sonar::bearing_of(j, bearings);
      const std::string place = fans.size() > 1 ? " place " + std::to_string(i + 1) : "";
      OceanCurve curve = without_sound(ocean, place + " " + degrees(bearing));
      curve.snr_db = snr_along(fans[i], bearing, plan);
      if (!curve.snr_db.empty()) curves.push_back(std::move(curve));
    }
  }
  for (OceanCurve& curve : curves) curve.weight = 1.0 / static_cast<double>(curves.size());
  return curves;
}

/// One march for each bearing from the source.
search::SnrFan fan_about_source(const ocean::Environment& environment, const CurvePlan& plan) {
  const auto ranges = static_cast<std::size_t>(std::ceil(plan.furthest() / kFanStep - 1e-9));
  const sonar::FanPlan fan{.bearings = plan.bearings,
                           .radial = {.source_depth = environment.source.depth,
                                      .depth_m = {plan.vehicle_depth.value},
                                      .range_step = kFanStep,
                                      .ranges = std::max<std::size_t>(1, ranges),
                                      .band = {environment.source.frequency, environment.source.frequency}}};
  return {.fan = sonar::compute_fan(environment, environment.source.position, fan, 1),
          .source_level = environment.source.level,
          .noise_level = environment.noise_level};
}

}  // namespace

double range_count(Meters furthest, Meters range_step) {
  constexpr double kRounding = 1e-9;
  return std::max(1.0, std::ceil(furthest.value / range_step.value - kRounding)) + 1.0;
}

std::vector<OceanCurve> curves_of(const BelievedOcean& ocean, const CurvePlan& plan) {
  const ocean::Environment& environment = ocean.environment;
  if (!ocean.field_library.empty()) {
    const search::Scenario scenario{.environment = environment, .field_library = ocean.field_library};
    return curves_of_fans(ocean, search::fans_of(scenario, plan.vehicle_depth, plan.furthest()), plan);
  }
  if (sonar::differs_with_place(environment)) {
    const search::SnrFan fan = fan_about_source(environment, plan);
    return curves_of_fans(ocean, std::span(&fan, 1), plan);
  }
  const Meters floor = sonar::deepest_sea_floor(environment, environment.source.position, 1, plan.furthest());
  if (!(plan.vehicle_depth < floor)) return {};
  return {curve_everywhere(ocean, plan)};
}

std::vector<OceanCurve> curves_of(const std::vector<BelievedOcean>& oceans, const CurvePlan& plan,
                                  const std::function<void(double share)>& progress,
                                  const std::function<void(const BelievedOcean&)>& without_water) {
  std::vector<std::vector<OceanCurve>> found(oceans.size());
  const std::size_t threads = parallel::available_processors();
  parallel::run_in_order(
      {.groups = oceans.size(), .tasks_per_group = 1, .threads = threads, .window = 2 * threads},
      [&](std::size_t task) { found[task] = curves_of(oceans[task], plan); },
      [&](std::size_t group) { progress(static_cast<double>(group + 1) / static_cast<double>(oceans.size())); });
  std::vector<OceanCurve> curves;
  for (std::size_t i = 0; i < oceans.size(); ++i) {
    if (found[i].empty()) without_water(oceans[i]);
    for (OceanCurve& curve : found[i]) curves.push_back(std::move(curve));
  }
  return curves;
}

}  // namespace earshot::tables
