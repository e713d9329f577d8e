#include "sim/sonar/model_files/receiver_grid.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <iterator>
#include <limits>
#include <optional>
#include <sstream>

#include "sim/ocean/section_along.hpp"
#include "sim/sonar/fan.hpp"
#include "sim/sonar/radial.hpp"

namespace earshot::sonar::model_files {
namespace {

constexpr double kSameRange_m = 1e-3;
constexpr double kNowhere = std::numeric_limits<double>::quiet_NaN();

/// By Euclid's algorithm, of numbers that are multiples to kSameRange_m; nothing where it would be shorter than `least_m`.
std::optional<double> common_step(const std::vector<double>& range_m, double least_m) {
  double step_m = 0.0;
  for (const double range : range_m) {
    double rest_m = range;
    while (rest_m > kSameRange_m) {
      const double before_m = rest_m;
      rest_m = step_m > 0.0 ? std::abs(std::remainder(step_m, rest_m)) : 0.0;
      step_m = before_m;
    }
    if (step_m > 0.0 && step_m < least_m) return std::nullopt;
  }
  const double longest_m = range_m.back();
  step_m = longest_m / std::round(longest_m / step_m);  // free of what Euclid's remainders have summed up
  const auto is_multiple = [step_m](double range) { return std::abs(std::remainder(range, step_m)) <= kSameRange_m; };
  if (!std::all_of(range_m.begin(), range_m.end(), is_multiple)) return std::nullopt;
  return step_m;
}

void cover_ranges(const ReceiverGrid& grid, RadialRequest& request) {
  constexpr double kSoundSpeed_mps = 1500.0;
  const double fine_m = kSoundSpeed_mps / request.band.high.value / 12.0;
  const double step_m = common_step(grid.range_m, fine_m).value_or(fine_m);
  request.output_step = Meters{step_m};
  request.max_range = Meters{step_m * std::ceil(grid.range_m.back() / step_m - 1e-6)};
}

/// A file holds all receivers of its grid, also those that are not computed.
void require_room(const ReceiverGrid& grid, const RadialRequest& request) {
  const double values = static_cast<double>(grid.depth_m.size()) * static_cast<double>(grid.range_m.size());
  if (values <= kMostFanValues) return;
  std::ostringstream text;
  text << "ranges x depths of the file are " << values << " values, must not exceed " << kMostFanValues;
  throw BadRequest(BadRequest::What::kOutputStep, request.output_step.value_or(request.max_range).value, text.str());
}

/// Where a range lies among the field's: on one of them, or between two.
struct Place {
  std::size_t below;
  std::size_t above;
  double fraction;
};

std::optional<Place> place_of(double range_m, const std::vector<double>& field_m) {
  const auto above = std::lower_bound(field_m.begin(), field_m.end(), range_m - kSameRange_m);
  if (above == field_m.end()) return std::nullopt;
  const auto i = static_cast<std::size_t>(above - field_m.begin());
  if (std::abs(*above - range_m) <= kSameRange_m) return Place{i, i, 0.0};
  if (i == 0) return std::nullopt;
  return Place{i - 1, i, (range_m - field_m[i - 1]) / (field_m[i] - field_m[i - 1])};
}

struct Sound {
  std::complex<double> pressure;
  float loss_db;
};

constexpr Sound kNone{{kNowhere, kNowhere}, std::numeric_limits<float>::quiet_NaN()};

class FieldLookup {
 public:
  explicit FieldLookup(const SonarField& field) : field_(field) {}

  [[nodiscard]] Sound at(double range_m, double depth_m) const {
    const std::optional<Place> place = place_of(range_m, field_.range_m);
    if (!place) return kNone;
    if (depth_m == 0.0) return surface(*place);
    const auto depth = std::lower_bound(field_.depth_m.begin(), field_.depth_m.end(), depth_m);
    if (depth == field_.depth_m.end() || *depth != depth_m) return kNone;
    const auto column = static_cast<std::size_t>(depth - field_.depth_m.begin());
    if (place->below == place->above)
      return {field_.pressure.empty() ? kNone.pressure : pressure(place->below, column), loss(place->below, column)};
    return field_.pressure.empty() ? between_losses(*place, column) : between(*place, column, range_m);
  }

  [[nodiscard]] float sea_floor_m(double range_m) const {
    const std::optional<Place> place = place_of(range_m, field_.range_m);
    if (!place) return kNone.loss_db;
    return std::lerp(field_.sea_floor_depth_m[place->below], field_.sea_floor_depth_m[place->above], static_cast<float>(place->fraction));
  }

 private:
  [[nodiscard]] std::complex<double> pressure(std::size_t range, std::size_t depth) const {
    return field_.pressure[range * field_.depth_m.size() + depth];
  }
  [[nodiscard]] float loss(std::size_t range, std::size_t depth) const { return field_.at(range, depth); }

  [[nodiscard]] Sound surface(const Place& place) const {
    const bool is_land = !(field_.sea_floor_depth_m[place.below] > 0.0F && field_.sea_floor_depth_m[place.above] > 0.0F);
    return is_land ? kNone : Sound{{0.0, 0.0}, static_cast<float>(kMaxTransmissionLoss.value)};
  }

  [[nodiscard]] Sound between_losses(const Place& place, std::size_t depth) const {
    return {kNone.pressure, std::lerp(loss(place.below, depth), loss(place.above, depth), static_cast<float>(place.fraction))};
  }

  [[nodiscard]] Sound between(const Place& place, std::size_t depth, double range_m) const {
    const auto spread = [&](std::size_t range) { return std::sqrt(field_.range_m[range]) * pressure(range, depth); };
    const std::complex<double> at =
        ((1.0 - place.fraction) * spread(place.below) + place.fraction * spread(place.above)) / std::sqrt(range_m);
    return std::isnan(at.real()) ? kNone : Sound{at, static_cast<float>(transmission_loss(std::norm(at)).value)};
  }

  const SonarField& field_;
};

}  // namespace

void cover(const ReceiverGrid& grid, const ocean::Environment& environment, Radians bearing, RadialRequest& request) {
  if (!grid.range_m.empty()) cover_ranges(grid, request);
  require_room(grid, request);
  if (grid.depth_m.empty()) return;
  const ocean::Section section = ocean::section_along(environment, environment.source.position, bearing, request.max_range);
  const double floor_m = deepest_sea_floor(section, request.max_range).value;
  request.depth_m.clear();
  std::copy_if(grid.depth_m.begin(), grid.depth_m.end(), std::back_inserter(request.depth_m),
               [floor_m](double depth_m) { return depth_m > 0.0 && depth_m <= floor_m; });
  if (request.depth_m.empty())
    throw BadRequest(BadRequest::What::kDepth, grid.depth_m.front(), "no receiver of the file lies in the water");
}

SonarField at_receivers(const SonarField& field, const ReceiverGrid& grid) {
  const FieldLookup lookup(field);
  SonarField result = field;
  if (!grid.depth_m.empty()) result.depth_m = grid.depth_m;
  if (!grid.range_m.empty()) result.range_m = grid.range_m;
  result.transmission_loss_db.clear();
  result.sea_floor_depth_m.clear();
  result.pressure.clear();
  for (const double range_m : result.range_m) {
    result.sea_floor_depth_m.push_back(lookup.sea_floor_m(range_m));
    for (const double depth_m : result.depth_m) {
      const Sound sound = lookup.at(range_m, depth_m);
      result.transmission_loss_db.push_back(sound.loss_db);
      if (!field.pressure.empty()) result.pressure.push_back(sound.pressure);
    }
  }
  return result;
}

}  // namespace earshot::sonar::model_files
