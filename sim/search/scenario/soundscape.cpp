#include "sim/search/scenario/soundscape.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <sstream>
#include <string>
#include <utility>

#include "firmware/host/toml/table_reader.hpp"
#include "sim/field_library/reader.hpp"
#include "sim/sonar/sonar_equation.hpp"
#include "sim/sonar/sonar_field.hpp"

namespace earshot::search {
namespace {

/// One value for each bearing and range, at its one depth.
[[maybe_unused]] bool is_filled(const SnrFan& f) {
  return f.fan.transmission_loss_db.size() == f.fan.bearings * f.fan.ranges;
}

}  // namespace

Soundscape::Soundscape(std::vector<sonar::SnrCurve> curves) : curves_(std::move(curves)) {
  assert(!curves_.empty());
}

Soundscape::Soundscape(sonar::SnrCurve expected, std::vector<SnrFan> fans) : curves_{std::move(expected)}, fans_(std::move(fans)) {
  assert(!fans_.empty());
  assert(std::ranges::all_of(fans_, is_filled));
}

std::size_t Soundscape::field_of(std::size_t ocean, NorthEast source) const {
  if (fans_.empty()) return ocean;
  const auto nearest = std::ranges::min_element(fans_, {}, [source](const SnrFan& f) { return range_between(f.fan.centre, source); });
  return static_cast<std::size_t>(nearest - fans_.begin());
}

Decibels Soundscape::snr(std::size_t field, NorthEast source, NorthEast receiver) const {
  if (fans_.empty()) return curves_[field].at(range_between(receiver, source));
  const SnrFan& f = fans_[field];
  const double loss_db = f.fan.transmission_loss_at(f.fan.centre + (receiver - source), 0);
  const Decibels loss = std::isnan(loss_db) ? sonar::kMaxTransmissionLoss : Decibels{loss_db};
  return sonar::signal_to_noise(f.source_level, loss, f.noise_level);
}

namespace {

constexpr double kSameDepth_m = 0.5;        // fields change little over that
constexpr double kSameFrequency_hz = 1e-6;  // rounding

std::string words(double number) {
  std::ostringstream text;
  text << number;
  return text.str();
}

/// Allocates for that depth alone, of which a library may hold many.
sonar::Fan fan_of_one_depth(const sonar::Fan& fan, std::size_t depth) {
  std::vector<float> loss_db;
  loss_db.reserve(fan.bearings * fan.ranges);
  for (std::size_t i = depth; i < fan.transmission_loss_db.size(); i += fan.depth_m.size()) loss_db.push_back(fan.transmission_loss_db[i]);
  return {.centre = fan.centre,
          .bearings = fan.bearings,
          .ranges = fan.ranges,
          .range_step = fan.range_step,
          .depth_m = {fan.depth_m[depth]},
          .transmission_loss_db = std::move(loss_db),
          .sea_floor_depth_m = {}};
}

}  // namespace

std::vector<SnrFan> fans_of(const Scenario& scenario, Meters vehicle_depth, Meters furthest) {
  const ocean::Environment& environment = scenario.environment;
  const auto refused = [&](const std::string& what) { return host::BadInput(scenario.field_library.string() + ": " + what); };
  const field_library::FieldLibrary library(scenario.field_library);
  if (library.centre() != field_library::Centre::kSource) throw refused("must have the source, not the hydrophone, at its positions");
  const ocean::Source& source = environment.source;
  if (!(std::abs((library.centre_depth() - source.depth).value) < kSameDepth_m))
    throw refused("has its sources at " + words(library.centre_depth().value) + " m, but source.depth_m of the environment is " +
                  words(source.depth.value));
  const double low_hz = library.frequency_hz().front();
  const double high_hz = library.frequency_hz().back();
  if (!(source.frequency.value >= low_hz - kSameFrequency_hz && source.frequency.value <= high_hz + kSameFrequency_hz))
    throw refused("is of sound from " + words(low_hz) + " to " + words(high_hz) + " Hz, but source.frequency_hz of the environment is " +
                  words(source.frequency.value));
  const std::vector<double>& depth_m = library.fans().front().depth_m;
  const auto depth = std::ranges::find_if(depth_m, [&](double d) { return std::abs(d - vehicle_depth.value) < kSameDepth_m; });
  if (depth == depth_m.end()) throw refused("has no fields at the vehicle's depth, " + std::to_string(vehicle_depth.value) + " m");
  std::vector<SnrFan> fans;
  for (const sonar::Fan& fan : library.fans()) {
    if (fan.max_range() < furthest) throw refused("must extend to " + std::to_string(furthest.value) + " m");
    fans.push_back({.fan = fan_of_one_depth(fan, static_cast<std::size_t>(depth - depth_m.begin())),
                    .source_level = source.level,
                    .noise_level = environment.noise_level});
  }
  if (!std::ranges::any_of(fans, [](const SnrFan& f) { return sonar::has_sound(f.fan); }))
    throw refused("has no water at the vehicle's depth, " + words(vehicle_depth.value) + " m: all its values there are missing");
  return fans;
}

Soundscape soundscape_of(const Scenario& scenario, Meters vehicle_depth, Meters furthest) {
  std::vector<sonar::SnrCurve> curves{sonar::compute_snr_curve(scenario.environment, vehicle_depth, furthest)};
  if (!scenario.field_library.empty()) return Soundscape(std::move(curves.front()), fans_of(scenario, vehicle_depth, furthest));
  for (const ocean::Environment& other : scenario.other_oceans) curves.push_back(sonar::compute_snr_curve(other, vehicle_depth, furthest));
  return Soundscape(std::move(curves));
}

}  // namespace earshot::search
