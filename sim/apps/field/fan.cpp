#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <optional>
#include <ostream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "firmware/host/program/progress_bar.hpp"
#include "firmware/host/program/talk.hpp"
#include "firmware/host/text/numbers.hpp"
#include "sim/apps/field/modes.hpp"
#include "sim/ocean/section_along.hpp"
#include "sim/parallel/ordered_tasks.hpp"
#include "sim/plot/field_plot.hpp"
#include "sim/sonar/detection.hpp"
#include "sim/sonar/fan.hpp"
#include "sim/sonar/fan_file.hpp"
#include "sim/sonar/grid_check.hpp"
#include "sim/sonar/horizontal_map.hpp"
#include "sim/sonar/radial_request.hpp"

namespace earshot::field {
namespace {

Meters map_side(const FieldArguments& arguments, const sonar::Fan& fan) {
  return arguments.map_side_km ? Meters{1000.0 * *arguments.map_side_km} : sonar::largest_side(fan);
}

std::optional<sonar::HorizontalMap> map_of(const FieldArguments& arguments, const sonar::Fan& fan, const sonar::Detector& detector) {
  if (!arguments.map) return std::nullopt;
  return sonar::make_map(fan, 0, {.side = map_side(arguments, fan), .intervals = arguments.map_intervals}, detector);
}

/// "25 km or further" where the computation ends there.
std::string range_to_string(const sonar::Fan& fan, double range_m) {
  return host::significant(range_m / 1000.0, 4) + " km" + (sonar::is_heard_to_the_end(fan, range_m) ? " or further" : "");
}

/// Of the bearings where it is heard. @param furthest_m  one or more
std::string last_heard(const sonar::Fan& fan, const std::vector<double>& furthest_m) {
  const auto [nearest, furthest] = std::minmax_element(furthest_m.begin(), furthest_m.end());
  if (*nearest == *furthest) return "last at " + range_to_string(fan, *furthest);
  std::ostringstream text;
  text << "last at " << range_to_string(fan, *nearest) << " to " << range_to_string(fan, *furthest) << ", by bearing";
  if (sonar::is_heard_to_the_end(fan, *furthest)) return text.str();  // what is only a bound has no mean
  const double mean_m = std::accumulate(furthest_m.begin(), furthest_m.end(), 0.0) / static_cast<double>(furthest_m.size());
  text << "; mean " << range_to_string(fan, mean_m);
  return text.str();
}

void print_detection(const sonar::Fan& fan, const sonar::Detector& detector) {
  for (std::size_t depth = 0; depth < fan.depth_m.size(); ++depth) {
    std::vector<double> furthest_m;
    for (const auto& range : sonar::detection_ranges(fan, depth, detector)) {
      if (!std::isnan(range.furthest_m)) furthest_m.push_back(range.furthest_m);
    }
    const std::size_t in_water = furthest_m.size();
    std::erase(furthest_m, 0.0);
    program::print() << "heard:   at " << fan.depth_m[depth] << " m ";
    if (in_water == 0)
      program::print() << "nowhere: there is no water at that depth beside the source\n";
    else if (furthest_m.empty())
      program::print() << "nowhere: the SNR stays below " << detector.detection_threshold.value << " dB at every range\n";
    else if (furthest_m.size() < in_water)
      program::print() << last_heard(fan, furthest_m) << "; on " << in_water - furthest_m.size() << " of " << in_water
                       << " bearings nowhere\n";
    else
      program::print() << last_heard(fan, furthest_m) << '\n';
  }
}

/// The worst of four bearings speaks for all.
void print_check(const ocean::Environment& environment, const sonar::RadialPlan& plan) {
  const int bearings = sonar::differs_with_place(environment) ? 4 : 1;
  std::vector<sonar::GridCheck> checks;
  {
    program::ProgressBar bar("check");
    for (int i = 0; i < bearings; ++i)
      checks.push_back(sonar::check_grid(
          ocean::section_along(environment, environment.source.position, Radians{0.5 * std::numbers::pi * i}, plan.max_range()),
          environment.name, plan, [&bar, i, bearings](double f) { bar.update((i + f) / bearings); }));
  }
  int degrees = 0;
  for (const sonar::GridCheck& check : checks) {
    program::print() << "check:   bearing " << degrees << ": absorber thicker, grid of " << check.depth_step.value << " m x "
                     << check.range_step.value << " m halved at " << plan.band.high.value << " Hz: loss changes by " << check.mean_db
                     << " dB in the mean, " << check.max_db << " dB at most (range " << check.range_of_max.value / 1000.0 << " km)\n";
    degrees += 90;
  }
}

}  // namespace

void write_fan(const FieldArguments& arguments) {
  const ocean::RadialCase asked = case_of(arguments);
  const ocean::Environment& environment = asked.environment;
  require_writable(arguments, environment);
  const NorthEast source = environment.source.position;
  const sonar::PlannedFan planned =
      sonar::plan_fan(environment, arguments.radials, request_of(arguments, asked, sonar::kFanStepWavelengths));
  const sonar::FanPlan& plan = planned.plan;
  if (planned.land) warn(*planned.land);

  const sonar::Fan fan = [&] {
    program::ProgressBar bar("radials");
    return sonar::compute_fan(environment, source, plan, arguments.threads.value_or(parallel::available_processors()),
                              [&bar](double fraction) { bar.update(fraction); });
  }();
  const sonar::Detector detector = detector_of(arguments, environment);
  const auto map = map_of(arguments, fan, detector);
  sonar::write_fan(arguments.output, fan, map, environment, plan.radial.band, detector, arguments.history);
  if (!arguments.plot.empty()) plot::plot_map(arguments.plot, fan, environment, plan.radial.band, map_side(arguments, fan), detector);

  program::print() << "ocean:   " << ocean_to_string(environment, plan.radial.band) << '\n'
                   << "fan:     " << fan.bearings << " bearings x " << fan.ranges << " ranges to " << fan.max_range().value / 1000.0
                   << " km"
                   << (sonar::differs_with_place(environment) ? "" : ", one march for all: this ocean is the same on every bearing")
                   << '\n';
  print_level_note(arguments);
  print_detection(fan, detector);
  program::print() << "written: " << arguments.output << (arguments.plot.empty() ? "" : ", " + arguments.plot) << '\n';
  warn(sonar::unmeasured_water(environment, source, plan.bearings, fan.max_range()));
  warn_of_doubt(sonar::doubt_of(fan, plan.radial.options.accuracy));
  if (arguments.check) print_check(environment, plan.radial);
}

}  // namespace earshot::field
