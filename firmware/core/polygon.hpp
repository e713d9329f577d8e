#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "firmware/core/geometry.hpp"
#include "firmware/core/units.hpp"

namespace earshot {

/// Corners of a polygon in their order, either way round; the last is joined to the first.
using Corners = std::span<const NorthEast>;

enum class PolygonFault : std::uint8_t {
  kNone = 0,
  kTooFewCorners = 1,  ///< less than three
  kNotFinite = 2,
  kRepeatedCorner = 3,  ///< two corners after each other are one place
  kCrossesItself = 4,   ///< or touches itself: two edges that are no neighbours meet, or two that are lie on each other
};

/// What is wrong with a polygon, and at which of its edges; edge i leads from corner i to the next.
struct PolygonComplaint {
  PolygonFault fault = PolygonFault::kNone;
  std::size_t edge = 0;   ///< or corner
  std::size_t other = 0;  ///< the edge that it crosses
  [[nodiscard]] bool is_none() const { return fault == PolygonFault::kNone; }
};

/// A polygon without a complaint encloses one area.   Oracle: PolygonCheck.*
[[nodiscard]] PolygonComplaint check_polygon(Corners polygon);

/// Whether a place lies in a polygon that check_polygon accepts; its edges belong to it. False for a place that is not finite.
/// Method: a ray crosses the edges an odd number of times. Oracle: Polygon.ContainsItsEdgesAndNoBay
[[nodiscard]] bool contains(Corners polygon, NorthEast place);

/// The place on the polygon's edges that is nearest to `place`; of several, the one on the first such edge.
[[nodiscard]] NorthEast nearest_on_edges(Corners polygon, NorthEast place);

/// Whether every place of `inner` lies in `outer` at least `margin` away from its edges. Both without a complaint.
[[nodiscard]] bool keeps_within(Corners inner, Corners outer, Meters margin);

}  // namespace earshot
