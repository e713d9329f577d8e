#include "sim/sonar/radial_request.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <sstream>

#include "sim/ocean/section_along.hpp"

namespace earshot::sonar {
namespace {

/// 10 m; in water so shallow that it would have less than a hundred depths 5, 2, 1, 0.5, 0.2 or 0.1 m.
double default_depth_spacing_m(Meters sea_floor) {
  constexpr std::array<double, 6> kFiner_m{5.0, 2.0, 1.0, 0.5, 0.2, 0.1};
  double spacing_m = 10.0;
  for (const double finer_m : kFiner_m) {
    if (100.0 * spacing_m > sea_floor.value) spacing_m = finer_m;
  }
  return spacing_m;
}

std::vector<double> receiver_depths(const RadialRequest& request, Meters sea_floor) {
  std::vector<double> depths = request.depth_m;
  if (!depths.empty() && depths.front() == 0.0)
    throw BadRequest(BadRequest::What::kDepth, 0.0,
                     "at the surface there is no sound, its pressure is released; a hydrophone hangs below it, at 1 m for example");
  for (const double depth : depths) {
    if (depth <= sea_floor.value) continue;
    std::ostringstream text;
    text << "must be from 0 m to the sea floor, at its deepest " << sea_floor.value << " m";
    throw BadRequest(BadRequest::What::kDepth, depth, text.str());
  }
  if (!depths.empty()) return depths;
  const double spacing_m = request.depth_spacing ? request.depth_spacing->value : default_depth_spacing_m(sea_floor);
  // Multiples, less one that falls on the sea floor but for rounding: a sum of tenths of a metre would miss it by a nanometre.
  const double spacings = std::max(1.0, std::ceil(sea_floor.value / spacing_m - 1e-6));
  for (std::size_t i = 1; i < static_cast<std::size_t>(spacings); ++i) depths.push_back(static_cast<double>(i) * spacing_m);
  depths.push_back(sea_floor.value);
  return depths;
}

std::string text_of(double value) {
  std::ostringstream text;
  text << value;
  return text.str();
}

double degrees(Radians angle) {
  return angle.value * 180.0 / std::numbers::pi;
}

void require_water(const ocean::Section& section, Radians bearing, Meters first_range) {
  const auto shore = shore_before(section, first_range);
  if (!shore) return;
  std::ostringstream text;
  text << "meets land " << shore->value << " m from the source, nearer than the first range of the field, " << first_range.value
       << " m: there is nothing to compute";
  throw BadRequest(BadRequest::What::kBearing, degrees(bearing), text.str());
}

/// The bearings that have no water as far as the first range, in degrees; of an ocean that is the same on all of them the first alone.
std::vector<double> dry_bearings_deg(const ocean::Environment& environment, const FanPlan& plan) {
  std::vector<double> dry_deg;
  const Meters first_range = plan.radial.range_step;
  for (std::size_t j = 0; j < (differs_with_place(environment) ? plan.bearings : 1); ++j) {
    const Radians bearing = bearing_of(j, plan.bearings);
    if (shore_before(ocean::section_along(environment, environment.source.position, bearing, first_range), first_range))
      dry_deg.push_back(degrees(bearing));
  }
  return dry_deg;
}

}  // namespace

BadRequest::BadRequest(What what, double value, const std::string& complaint)
    : std::invalid_argument(text_of(value) + ": " + complaint), what_(what), value_(value), complaint_(complaint) {}

std::string BadRequest::called(const std::string& name) const {
  return name + " = " + text_of(value_) + ": " + complaint_;
}

RadialPlan plan_ranges(const RadialRequest& request, Meters source_depth) {
  RadialPlan plan{
      .source_depth = source_depth, .depth_m = {}, .range_step = {}, .ranges = 1, .band = request.band, .options = request.options};
  constexpr double kSoundSpeed_mps = 1500.0;
  const Meters automatic{std::min(request.default_step_wavelengths * kSoundSpeed_mps / plan.band.high.value, request.max_range.value)};
  plan.range_step = request.output_step.value_or(request.options.range_step.value_or(automatic));
  plan.ranges = static_cast<std::size_t>(request.max_range.value / plan.range_step.value + 1e-9);
  if (plan.ranges < 1)
    throw BadRequest(BadRequest::What::kOutputStep, plan.range_step.value,
                     "must not be longer than the range of the field, " + text_of(request.max_range.value) + " m");
  return plan;
}

void plan_depths(const RadialRequest& request, std::size_t radials, Meters deepest_sea_floor, RadialPlan& plan) {
  plan.depth_m = receiver_depths(request, deepest_sea_floor);
  const double values = static_cast<double>(radials) * static_cast<double>(plan.ranges) * static_cast<double>(plan.depth_m.size());
  if (values <= kMostFanValues) return;
  std::ostringstream text;
  text << "radials x ranges x depths are " << values << " values, must not exceed " << kMostFanValues
       << "; take a longer step, fewer depths or a shorter range";
  throw BadRequest(BadRequest::What::kOutputStep, plan.range_step.value, text.str());
}

PlannedRadial plan_radial(const ocean::Environment& environment, Radians bearing, const RadialRequest& request) {
  PlannedRadial radial{.section = {}, .plan = plan_ranges(request, environment.source.depth)};
  radial.section = ocean::section_along(environment, environment.source.position, bearing, radial.plan.max_range());
  plan_depths(request, 1, deepest_sea_floor(radial.section, radial.plan.max_range()), radial.plan);
  require_water(radial.section, bearing, radial.plan.range_step);
  return radial;
}

PlannedFan plan_fan(const ocean::Environment& environment, std::size_t bearings, const RadialRequest& request) {
  PlannedFan fan{.plan = {.bearings = bearings, .radial = plan_ranges(request, environment.source.depth)}};
  RadialPlan& radial = fan.plan.radial;
  plan_depths(request, bearings, deepest_sea_floor(environment, environment.source.position, bearings, radial.max_range()), radial);
  const std::vector<double> dry_deg = dry_bearings_deg(environment, fan.plan);
  if (dry_deg.empty()) return fan;
  const std::string land = "meet land nearer than the first range, " + text_of(radial.range_step.value) + " m: there is no number on them";
  if (dry_deg.size() == bearings || !differs_with_place(environment))
    throw BadRequest(BadRequest::What::kRadials, static_cast<double>(bearings), "all of them " + land);
  fan.land = std::to_string(dry_deg.size()) + " of " + std::to_string(bearings) + " bearings (the first at " + text_of(dry_deg.front()) +
             " degrees) " + land;
  return fan;
}

}  // namespace earshot::sonar
