#include <cmath>
#include <iostream>
#include <numbers>
#include <optional>
#include <ostream>
#include <sstream>

#include "firmware/host/file/printable.hpp"
#include "firmware/host/program/progress_bar.hpp"
#include "firmware/host/program/talk.hpp"
#include "sim/apps/field/modes.hpp"
#include "sim/plot/field_plot.hpp"
#include "sim/sonar/field_file.hpp"
#include "sim/sonar/grid_check.hpp"
#include "sim/sonar/model_files/receiver_grid.hpp"
#include "sim/sonar/model_files/shade_file.hpp"
#include "sim/sonar/model_files/tl_grid.hpp"
#include "sim/sonar/radial_request.hpp"
#include "sim/sonar/sonar_field.hpp"

namespace earshot::field {
namespace {

void print_check(const ocean::Section& section, const std::string& name, const sonar::RadialPlan& plan) {
  const auto check = [&] {
    program::ProgressBar bar("check");
    return sonar::check_grid(section, name, plan, [&bar](double f) { bar.update(f); });
  }();
  program::print() << "check:   absorber thicker, grid of " << check.depth_step.value << " m x " << check.range_step.value
                   << " m halved at " << plan.band.high.value << " Hz: loss changes by " << check.mean_db << " dB in the mean, "
                   << check.max_db << " dB at most (range " << check.range_of_max.value / 1000.0 << " km, depth "
                   << check.depth_of_max.value << " m)\n";
}

/// Beyond a shore there is no field: what the numbers that are missing mean.
void warn_of_land(const ocean::Section& section, Meters last_range) {
  const auto shore = sonar::shore_before(section, last_range);
  if (!shore) return;
  std::ostringstream text;
  text << "the bearing meets land " << shore->value << " m from the source: from there on the field holds no number";
  warn(text.str());
}

Radians bearing_of(const FieldArguments& arguments) {
  return Radians{arguments.bearing_deg * std::numbers::pi / 180.0};
}

void write_output(const FieldArguments& arguments, const sonar::SonarField& field, const ocean::Environment& environment,
                  const ocean::Band& band) {
  using namespace sonar::model_files;
  switch (format_of(arguments)) {
    case OutputFormat::kShade:
      return write_shade(arguments.output, field,
                         {.title = environment.name, .frequency = environment.source.frequency, .depth = environment.source.depth},
                         arguments.shd_layout == "single" ? ShadeLayout::kSingle : ShadeLayout::kDouble);
    case OutputFormat::kGrid:
      return write_tl_grid(arguments.output, field);
    case OutputFormat::kNetcdf:
      return sonar::write_field(arguments.output, field, environment, bearing_of(arguments), band, arguments.history);
  }
}

std::string ranges_to_string(const sonar::SonarField& field) {
  std::ostringstream text;
  text << field.range_m.size() << (field.range_m.size() == 1 ? " range, " : " ranges to ") << field.range_m.back() / 1000.0 << " km";
  return text.str();
}

std::string depths_to_string(const sonar::SonarField& field) {
  std::ostringstream text;
  if (field.depth_m.size() == 1)
    text << "at a depth of " << field.depth_m.front() << " m";
  else
    text << field.depth_m.size() << " depths from " << field.depth_m.front() << " to " << field.depth_m.back() << " m";
  return text.str();
}

}  // namespace

std::string ocean_to_string(const ocean::Environment& environment, const ocean::Band& band) {
  std::ostringstream text;
  text << host::printable(environment.name) << ", source of " << band.low.value;
  if (band.high > band.low) text << " to " << band.high.value;
  text << " Hz at " << environment.source.depth.value << " m";
  return text.str();
}

void warn(const std::string& what) {
  std::cerr << "earshot field: warning: " << what << '\n';
}

void warn(const std::optional<ocean::UnmeasuredWater>& water) {
  if (water) warn(to_string(*water));
}

void warn_of_doubt(const std::optional<std::string>& doubt) {
  if (doubt) warn(*doubt + ": smooth it, or check the field with other steps (--check)");
}

void write_radial(const FieldArguments& arguments) {
  const ocean::RadialCase asked = case_of(arguments);
  const ocean::Environment& environment = asked.environment;
  require_writable(arguments, environment);
  const Radians bearing = bearing_of(arguments);
  const sonar::model_files::ReceiverGrid grid = grid_of(arguments, asked);
  sonar::RadialRequest request = request_of(arguments, asked, sonar::kRadialStepWavelengths);
  sonar::model_files::cover(grid, environment, bearing, request);
  const sonar::PlannedRadial radial = sonar::plan_radial(environment, bearing, request);
  const ocean::Section& section = radial.section;
  const sonar::RadialPlan& plan = radial.plan;

  // Between two ranges of the march pressure is had from pressure alone.
  const bool keeps_pressure = arguments.band_hz.empty() && (format_of(arguments) != OutputFormat::kNetcdf || !grid.range_m.empty());
  const sonar::SonarField computed = [&] {
    program::ProgressBar bar("field");
    return sonar::compute_sonar_field(
        environment, section, plan, [&bar](double fraction) { bar.update(fraction); },
        keeps_pressure ? sonar::Pressure::kKept : sonar::Pressure::kLeftOut);
  }();
  const bool is_at_receivers = !grid.depth_m.empty() || !grid.range_m.empty();
  const std::optional<sonar::SonarField> at_receivers =
      is_at_receivers ? std::optional(sonar::model_files::at_receivers(computed, grid)) : std::nullopt;
  const sonar::SonarField& field = at_receivers ? *at_receivers : computed;
  write_output(arguments, field, environment, plan.band);
  if (!arguments.plot.empty())
    plot::plot_field(arguments.plot, computed, environment, plan.band, bearing, Decibels{arguments.detection_threshold_db});

  program::print() << "ocean:   " << ocean_to_string(environment, plan.band) << '\n'
                   << "field:   " << ranges_to_string(field) << ", " << depths_to_string(field) << '\n';
  print_level_note(arguments);
  program::print() << "written: " << arguments.output << (arguments.plot.empty() ? "" : ", " + arguments.plot) << '\n';
  warn(field.unmeasured);
  warn_of_doubt(doubt_of(computed, plan.options.accuracy));
  warn_of_land(section, plan.max_range());
  if (arguments.check) print_check(section, environment.name, plan);
}

}  // namespace earshot::field
