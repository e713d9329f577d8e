#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "firmware/core/geometry.hpp"
#include "firmware/core/units.hpp"
#include "sim/ocean/environment.hpp"
#include "sim/pe/options.hpp"
#include "sim/pe/solver.hpp"
#include "sim/sonar/radial.hpp"

namespace earshot::sonar {

/// Transmission loss around one position, radial by radial (N x 2D): each is a vertical plane of its own, no sound crosses from one to
/// another.
struct Fan {
  NorthEast centre;
  std::size_t bearings;  ///< bearing j is 360 degrees j / bearings, clockwise from north
  std::size_t ranges;    ///< range i is (i + 1) range_step
  Meters range_step;
  std::vector<double> depth_m;
  std::vector<float> transmission_loss_db;  ///< [n_bearing x n_range x n_depth], dB re 1 m; NaN where there is no water
  std::vector<float> sea_floor_depth_m;     ///< [n_bearing x n_range]; 0 on land
  /// [n_bearing], or empty of a fan that was read; nothing where there was nothing to march through
  std::vector<std::optional<pe::MarchGrid>> grid = {};

  [[nodiscard]] Meters max_range() const { return static_cast<double>(ranges) * range_step; }
  [[nodiscard]] float at(std::size_t bearing, std::size_t range, std::size_t depth) const {
    return transmission_loss_db[(bearing * ranges + range) * depth_m.size() + depth];
  }

  /// Transmission loss in the plane, in constant time and without allocating: linear in dB along range and then between the two radials
  /// beside. Nearer than range_step it is that at range_step; NaN beyond the last range, where a neighbour is NaN, or for NaN.
  ///
  /// In dB and not in intensity or pressure, because interference minima would otherwise vanish between samples; between radials only the
  /// trend is right once they stand further apart than the interference pattern is long.
  /// Oracle: Fan.IsLinearInDecibelsBetweenItsRadialsAndRanges
  [[nodiscard]] double transmission_loss_at(NorthEast position, std::size_t depth) const;
};

/// Linear from a to b; NaN for a NaN but beside the point that is asked for. (std::lerp of libstdc++ 12 returns b when a is NaN.)
[[nodiscard]] constexpr double between(double a, double b, double fraction) {
  constexpr double kRounding = 1e-9;
  if (fraction < kRounding) return a;
  if (fraction > 1.0 - kRounding) return b;
  return a + fraction * (b - a);
}

inline double Fan::transmission_loss_at(NorthEast position, std::size_t depth) const {
  const double north = (position.north - centre.north).value;
  const double east = (position.east - centre.east).value;
  const double distance = std::hypot(north, east) / range_step.value;
  if (!(distance <= static_cast<double>(ranges) + 1e-9)) return std::numeric_limits<double>::quiet_NaN();
  const double range = std::max(0.0, distance - 1.0);
  double turn = std::atan2(east, north) / (2.0 * std::numbers::pi);
  if (turn < 0.0) turn += 1.0;

  const double bearing = turn * static_cast<double>(bearings);
  const auto i = std::min(static_cast<std::size_t>(range), ranges - 1);
  const auto j = static_cast<std::size_t>(bearing);
  const auto along = [&](std::size_t radial) {
    const double near = static_cast<double>(at(radial % bearings, i, depth));
    const double fraction = range - static_cast<double>(i);
    return i + 1 == ranges ? near : between(near, static_cast<double>(at(radial % bearings, i + 1, depth)), fraction);
  };
  const double fraction = bearing - static_cast<double>(j);
  return between(along(j), along(j + 1), fraction);
}

/// Its axes: bearings clockwise from north, and horizontal ranges.
[[nodiscard]] std::vector<double> bearings_deg(const Fan& fan);
[[nodiscard]] std::vector<double> ranges_m(const Fan& fan);

/// Of all its marches the shortest steps, the most terms and the largest predicted error; nothing where there was none.
/// Oracle: Fan.KnowsTheLargestErrorOfItsBearings
[[nodiscard]] std::optional<pe::MarchGrid> grid_of(const Fan& fan);

/// What must be known of a fan some bearing of which is predicted to be far off: pe::doubt_of.
[[nodiscard]] std::optional<std::string> doubt_of(const Fan& fan, Decibels accuracy);

/// Whether there is water in it: any value that is not NaN.
[[nodiscard]] bool has_sound(const Fan& fan);

struct FanPlan {
  std::size_t bearings;  ///< >= 1
  RadialPlan radial;
};

/// @param threads   on which radials are computed; the result is the same bit for bit whatever their number
/// @param progress  called from these threads, from one at a time; what it throws ends the work, and is thrown here
/// One march serves all bearings when the ocean does not differ with place. Throws as ocean::section_along and compute_radial do.
/// Oracle: Fan.*
[[nodiscard]] Fan compute_fan(const ocean::Environment& environment, NorthEast centre, const FanPlan& plan, std::size_t threads,
                              const pe::Progress& progress = {});

/// More is refused, by libraries and by `earshot field`: 256 MB of loss, of which a march and its files need a few times as much.
inline constexpr double kMostFanValues = 64e6;

/// The deepest sea floor on any radial. Throws as ocean::section_along does: it looks at all that the radials need.
[[nodiscard]] Meters deepest_sea_floor(const ocean::Environment& environment, NorthEast centre, std::size_t bearings, Meters max_range);

/// The thickest water on any radial that was not measured but extended, if any. Throws as ocean::section_along does.
[[nodiscard]] std::optional<ocean::UnmeasuredWater> unmeasured_water(const ocean::Environment& environment, NorthEast centre,
                                                                     std::size_t bearings, Meters max_range);

/// An empty fan of the plan's shape.
[[nodiscard]] Fan make_fan(NorthEast centre, const FanPlan& plan);

/// Computes one radial of a fan in its place. Different bearings may be filled from different threads.
void fill_bearing(const ocean::Environment& environment, const FanPlan& plan, std::size_t bearing, Fan& fan,
                  const pe::Progress& progress = {});

/// Copies the first radial to all others: what an ocean does that is the same everywhere.
void repeat_first_bearing(Fan& fan);

}  // namespace earshot::sonar
