#pragma once

#include <cstddef>
#include <span>

#include "firmware/core/geometry.hpp"
#include "firmware/core/math.hpp"
#include "firmware/policy/belief/belief_model.hpp"

namespace earshot::policy::places {

// What find_action_values() counts in; for action_values.cpp alone: whoever else included it might fuse what it computes.

/// A place in metres from the south-west corner. Floats are exact enough.
struct Point {
  float north;
  float east;
};

inline float distance(Point a, Point b) {
  const float north = a.north - b.north;
  const float east = a.east - b.east;
  return __builtin_sqrtf(north * north + east * east);
}

inline Point point_at(NorthEast place) {
  return {static_cast<float>(place.north.value), static_cast<float>(place.east.value)};
}

/// The search area without its border, and B(y), how deep a place lies in the border.
struct BorderFreeArea {
  Point low;
  Point high;
  float width;  ///< of the border

  explicit BorderFreeArea(const BeliefModel& model)
      : low{static_cast<float>(model.border_width.value), static_cast<float>(model.border_width.value)},
        high{static_cast<float>((model.area_size.north - model.border_width).value),
             static_cast<float>((model.area_size.east - model.border_width).value)},
        width(static_cast<float>(model.border_width.value)) {}

  /// B(y): 0 inside, 1 at the edge, more beyond.
  [[nodiscard]] float border_depth(Point p) const {
    const float north = greater(low.north - p.north, p.north - high.north);
    const float east = greater(low.east - p.east, p.east - high.east);
    return greater(greater(north, east), 0.0F) / width;
  }
  [[nodiscard]] Point nearest(Point p) const {
    return {greater(low.north, lesser(p.north, high.north)), greater(low.east, lesser(p.east, high.east))};
  }
};

/// The cells of the belief.
struct Grid {
  std::span<const float> probabilities;
  std::size_t rows;
  std::size_t columns;
  float size_north;
  float size_east;

  Grid(const BeliefModel& model, std::span<const float> of_cells)
      : probabilities(of_cells),
        rows(model.cells_north),
        columns(model.cells_east),
        size_north(static_cast<float>(model.area_size.north.value / static_cast<double>(model.cells_north))),
        size_east(static_cast<float>(model.area_size.east.value / static_cast<double>(model.cells_east))) {}
};

}  // namespace earshot::policy::places
