#pragma once

#include "firmware/core/math.hpp"
#include "firmware/core/units.hpp"

namespace earshot {

/// A horizontal position or displacement in the local north-east plane of the mission (origin: the mission's geographic origin).
struct NorthEast {
  Meters north;
  Meters east;

  friend constexpr NorthEast operator+(NorthEast a, NorthEast b) { return {a.north + b.north, a.east + b.east}; }
  friend constexpr NorthEast operator-(NorthEast a, NorthEast b) { return {a.north - b.north, a.east - b.east}; }
  friend constexpr bool operator==(NorthEast, NorthEast) = default;
};

/// Whether neither coordinate is NaN or infinite.   Oracle: NorthEast.IsFiniteWhenBothCoordinatesAre
[[nodiscard]] constexpr bool is_finite(NorthEast place) {
  return is_finite(place.north.value) && is_finite(place.east.value);
}

/// A horizontal direction of length one; compass directions come from a table, not from libm, so that every machine has the same bits.
struct UnitNorthEast {
  double north = 1.0;
  double east = 0.0;

  friend constexpr bool operator==(UnitNorthEast, UnitNorthEast) = default;
};

constexpr NorthEast operator*(Meters length, const UnitNorthEast& direction) {
  return {length * direction.north, length * direction.east};
}

/// Horizontal length of a displacement; NaN stays NaN.   Oracle: LengthOf.IsTheHypotenuse
[[nodiscard]] Meters length_of(NorthEast displacement);

/// Horizontal distance between two places.
[[nodiscard]] Meters range_between(NorthEast a, NorthEast b);

/// Axis-aligned rectangle in the north-east plane; its edges belong to it.
struct Rectangle {
  NorthEast south_west;
  NorthEast north_east;
  friend constexpr bool operator==(const Rectangle&, const Rectangle&) = default;

  [[nodiscard]] constexpr bool contains(NorthEast p) const {
    return p.north >= south_west.north && p.north <= north_east.north && p.east >= south_west.east && p.east <= north_east.east;
  }

  /// Distance from p to the nearest edge; negative outside the rectangle when p is beyond an edge (then: how far beyond the furthest one).
  [[nodiscard]] constexpr Meters distance_to_edge(NorthEast p) const {
    const Meters to_south = p.north - south_west.north;
    const Meters to_north = north_east.north - p.north;
    const Meters to_west = p.east - south_west.east;
    const Meters to_east = north_east.east - p.east;
    const Meters vertical = to_south < to_north ? to_south : to_north;
    const Meters horizontal = to_west < to_east ? to_west : to_east;
    return vertical < horizontal ? vertical : horizontal;
  }

  /// The rectangle with every edge moved in by `margin`.
  [[nodiscard]] constexpr Rectangle moved_in(Meters margin) const {
    return {south_west + NorthEast{margin, margin}, north_east - NorthEast{margin, margin}};
  }
};

}  // namespace earshot
