#include "firmware/desk/journal_view/export/maps/places.hpp"

#include <algorithm>

#include "firmware/host/text/numbers.hpp"

namespace earshot::journal {
namespace {

constexpr double kHalfTurn_deg = 180.0;
constexpr double kFullTurn_deg = 360.0;

using Places = std::vector<MapPlace>;

/// @param share  of the way from `a` to `b`
MapPlace between(const MapPlace& a, const MapPlace& b, double share) {
  return {.latitude_deg = std::lerp(a.latitude_deg, b.latitude_deg, share),
          .longitude_deg = std::lerp(a.longitude_deg, b.longitude_deg, share),
          .depth_m = std::lerp(a.depth_m, b.depth_m, share),
          .time = {a.time.us + static_cast<std::int64_t>(static_cast<double>(b.time.us - a.time.us) * share)}};
}

MapPlace turned(MapPlace place, double by_deg) {
  place.longitude_deg += by_deg;
  return place;
}

/// With longitudes that go on beyond 180 degrees, so that none jumps: none is half the earth away from the first.
Places without_jumps(std::span<const MapPlace> places) {
  Places smooth(places.begin(), places.end());
  for (MapPlace& place : smooth) {
    const double from_first_deg = place.longitude_deg - places.front().longitude_deg;
    if (std::abs(from_first_deg) > kHalfTurn_deg) place.longitude_deg -= std::copysign(kFullTurn_deg, from_first_deg);
  }
  return smooth;
}

/// Twice its area in square degrees, positive when it is counterclockwise.
double turning(const Places& ring) {
  double sum = 0.0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const MapPlace& a = ring[i];
    const MapPlace& b = ring[(i + 1) % ring.size()];
    sum += (a.longitude_deg - ring[0].longitude_deg) * (b.latitude_deg - ring[0].latitude_deg) -
           (b.longitude_deg - ring[0].longitude_deg) * (a.latitude_deg - ring[0].latitude_deg);
  }
  return sum;
}

/// What of a ring lies on one side of a meridian. @param side  1: east of it, -1: west
/// Source: Sutherland and Hodgman 1974, Reentrant Polygon Clipping
Places clipped(const Places& ring, double meridian_deg, double side) {
  Places kept;
  const auto inside = [&](const MapPlace& place) { return side * (place.longitude_deg - meridian_deg); };
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const MapPlace& from = ring[i];
    const MapPlace& to = ring[(i + 1) % ring.size()];
    if (inside(from) >= 0.0) kept.push_back(from);
    if (inside(from) * inside(to) < 0.0) kept.push_back(between(from, to, inside(from) / (inside(from) - inside(to))));
  }
  return kept;
}

}  // namespace

std::optional<MapPlace> place_of(NorthEast place, const n2k::LocalPlane& plane) {
  const Result<n2k::Geographic> geographic = plane.to_geographic(place);
  if (!geographic.ok()) return std::nullopt;
  return MapPlace{.latitude_deg = geographic.value().latitude_deg, .longitude_deg = geographic.value().longitude_deg};
}

std::string degrees_text(double degrees) {
  return host::decimals(degrees, 7);
}

std::string altitude_text(const MapPlace& place) {
  return host::decimals(0.0 - place.depth_m, 3);
}

std::vector<Places> pieces_of_line(std::span<const MapPlace> line) {
  std::vector<Places> pieces(1);
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (i > 0 && std::abs(line[i].longitude_deg - line[i - 1].longitude_deg) > kHalfTurn_deg) {
      const double edge_deg = std::copysign(kHalfTurn_deg, line[i - 1].longitude_deg);
      const MapPlace beyond = turned(line[i], 2.0 * edge_deg);
      const double share = (edge_deg - line[i - 1].longitude_deg) / (beyond.longitude_deg - line[i - 1].longitude_deg);
      MapPlace cut = between(line[i - 1], beyond, share);
      cut.longitude_deg = edge_deg;
      pieces.back().push_back(cut);
      cut.longitude_deg = -edge_deg;
      pieces.push_back({cut});
    }
    pieces.back().push_back(line[i]);
  }
  std::erase_if(pieces, [](const Places& piece) { return piece.size() < 2; });
  return pieces;
}

std::vector<Places> pieces_of_ring(std::span<const MapPlace> corners) {
  if (corners.size() < 3) return {};
  const Places ring = without_jumps(corners);
  std::vector<Places> pieces;
  const auto [west, east] = std::ranges::minmax(ring, {}, &MapPlace::longitude_deg);
  if (west.longitude_deg < -kHalfTurn_deg) {
    pieces = {clipped(ring, -kHalfTurn_deg, 1.0), clipped(ring, -kHalfTurn_deg, -1.0)};
    for (MapPlace& place : pieces[1]) place = turned(place, kFullTurn_deg);
  } else if (east.longitude_deg > kHalfTurn_deg) {
    pieces = {clipped(ring, kHalfTurn_deg, -1.0), clipped(ring, kHalfTurn_deg, 1.0)};
    for (MapPlace& place : pieces[1]) place = turned(place, -kFullTurn_deg);
  } else {
    pieces = {ring};
  }
  std::erase_if(pieces, [](const Places& piece) { return piece.size() < 3; });
  for (Places& piece : pieces)
    if (turning(piece) < 0.0) std::ranges::reverse(piece);
  return pieces;
}

}  // namespace earshot::journal
