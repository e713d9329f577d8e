#include "firmware/core/polygon.hpp"

#include <algorithm>

namespace earshot {
namespace {

struct Edge {
  NorthEast from;
  NorthEast to;
};

Edge edge_of(Corners polygon, std::size_t i) {
  return {.from = polygon[i], .to = polygon[i + 1 == polygon.size() ? 0 : i + 1]};
}

/// Twice the area of the triangle, positive when `c` lies to the right of the way from `a` to `b`.
double turn(NorthEast a, NorthEast b, NorthEast c) {
  const NorthEast ab = b - a;
  const NorthEast ac = c - a;
  return ab.north.value * ac.east.value - ab.east.value * ac.north.value;
}

double dot(NorthEast a, NorthEast b) {
  return a.north.value * b.north.value + a.east.value * b.east.value;
}

/// Of a place on the line through the edge.
bool is_between_ends(const Edge& edge, NorthEast place) {
  return place.north >= std::min(edge.from.north, edge.to.north) && place.north <= std::max(edge.from.north, edge.to.north) &&
         place.east >= std::min(edge.from.east, edge.to.east) && place.east <= std::max(edge.from.east, edge.to.east);
}

bool lies_on(const Edge& edge, NorthEast place) {
  return turn(edge.from, edge.to, place) == 0.0 && is_between_ends(edge, place);
}

/// Whether they have a place in common.
bool do_meet(const Edge& a, const Edge& b) {
  if (lies_on(a, b.from) || lies_on(a, b.to) || lies_on(b, a.from) || lies_on(b, a.to)) return true;
  return (turn(a.from, a.to, b.from) > 0.0) != (turn(a.from, a.to, b.to) > 0.0) &&
         (turn(b.from, b.to, a.from) > 0.0) != (turn(b.from, b.to, a.to) > 0.0);
}

/// Of two edges of which the second begins where the first ends.
bool does_turn_back(const Edge& first, const Edge& second) {
  return turn(first.from, first.to, second.to) == 0.0 && dot(first.to - first.from, second.to - second.from) < 0.0;
}

NorthEast nearest_on(const Edge& edge, NorthEast place) {
  const NorthEast way = edge.to - edge.from;
  const double square = dot(way, way);
  if (!(square > 0.0)) return edge.from;
  const double share = std::clamp(dot(place - edge.from, way) / square, 0.0, 1.0);
  return edge.from + NorthEast{.north = way.north * share, .east = way.east * share};
}

/// Of two edges that do not meet, which are nearest to each other at an end of one.
Meters distance_between(const Edge& a, const Edge& b) {
  return std::min(std::min(range_between(nearest_on(a, b.from), b.from), range_between(nearest_on(a, b.to), b.to)),
                  std::min(range_between(nearest_on(b, a.from), a.from), range_between(nearest_on(b, a.to), a.to)));
}

bool are_neighbours(std::size_t i, std::size_t j, std::size_t edges) {
  return j == i + 1 || (i == 0 && j + 1 == edges);
}

/// @param i,j  i < j
bool do_cross(Corners polygon, std::size_t i, std::size_t j) {
  const Edge a = edge_of(polygon, i);
  const Edge b = edge_of(polygon, j);
  if (!are_neighbours(i, j, polygon.size())) return do_meet(a, b);
  return j == i + 1 ? does_turn_back(a, b) : does_turn_back(b, a);
}

}  // namespace

PolygonComplaint check_polygon(Corners polygon) {
  if (polygon.size() < 3) return {.fault = PolygonFault::kTooFewCorners, .edge = polygon.size()};
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    if (!is_finite(polygon[i])) return {.fault = PolygonFault::kNotFinite, .edge = i};
  }
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Edge edge = edge_of(polygon, i);
    if (edge.from == edge.to) return {.fault = PolygonFault::kRepeatedCorner, .edge = i};
  }
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    for (std::size_t j = i + 1; j < polygon.size(); ++j) {
      if (do_cross(polygon, i, j)) return {.fault = PolygonFault::kCrossesItself, .edge = i, .other = j};
    }
  }
  return {};
}

bool contains(Corners polygon, NorthEast place) {
  if (!is_finite(place)) return false;
  bool is_in = false;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Edge edge = edge_of(polygon, i);
    if (lies_on(edge, place)) return true;
    const bool goes_up = edge.to.north > edge.from.north;
    const bool spans = (edge.from.north > place.north) != (edge.to.north > place.north);  // a corner belongs to one of its edges only
    if (spans && (turn(edge.from, edge.to, place) > 0.0) != goes_up) is_in = !is_in;      // it lies west of the edge
  }
  return is_in;
}

NorthEast nearest_on_edges(Corners polygon, NorthEast place) {
  NorthEast nearest = polygon[0];
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const NorthEast candidate = nearest_on(edge_of(polygon, i), place);
    if (range_between(candidate, place) < range_between(nearest, place)) nearest = candidate;
  }
  return nearest;
}

bool keeps_within(Corners inner, Corners outer, Meters margin) {
  if (!contains(outer, inner[0])) return false;
  for (std::size_t i = 0; i < inner.size(); ++i) {
    for (std::size_t j = 0; j < outer.size(); ++j) {
      const Edge a = edge_of(inner, i);
      const Edge b = edge_of(outer, j);
      if (do_meet(a, b) || distance_between(a, b) < margin) return false;
    }
  }
  return true;
}

}  // namespace earshot
