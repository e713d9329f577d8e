#include "firmware/desk/checklist/chart.hpp"

#include <vector>

#include "firmware/desk/map/svg_map.hpp"
#include "firmware/host/text/numbers.hpp"

namespace earshot::board {
namespace {

using Style = SvgMap::Style;
constexpr Style kBox{"#24303a", "#e8eef3", 1.2, ""};
constexpr Style kWaypoints{"#5b6b78", "none", 1.0, "2 4"};
constexpr Style kInside{"#1b7f5c", "none", 2.0, ""};
constexpr Style kSave{"#c77700", "none", 2.0, "9 5"};
constexpr Style kHalt{"#b3261e", "none", 2.5, ""};
constexpr Style kZone{"#6a3d9a", "#d9c8ea", 1.5, ""};
constexpr SvgMap::Dot kSafePoint{"#0b57a4", "white", 6, 2};

std::vector<NorthEast> places_of(const config::Mission& mission) {
  std::vector<NorthEast> places = corners_of(mission.operating_area);
  const auto add = [&places](const config::Polygon& polygon) {
    const auto corners = polygon.span();
    places.insert(places.end(), corners.begin(), corners.end());
  };
  if (const auto& fence = mission.safety.fence) {
    for (const config::Polygon* tier : {&fence->inside, &fence->save, &fence->halt}) add(*tier);
  }
  for (const config::Polygon& zone : mission.safety.no_surface) add(zone);
  if (mission.safety.safe_point) places.push_back(*mission.safety.safe_point);
  return places;
}

}  // namespace

std::string chart(const config::Mission& mission, const std::string& title) {
  const config::Safety& safety = mission.safety;
  SvgMap map(places_of(mission), title);
  map.polygon(corners_of(mission.operating_area), kBox);
  const NorthEast size = mission.operating_area.north_east - mission.operating_area.south_west;
  map.legend(kBox, "search area", host::formatted("%.1f km x %.1f km", size.north.value * 1e-3, size.east.value * 1e-3));
  for (const config::Polygon& zone : safety.no_surface) map.polygon(zone.span(), kZone);
  if (mission.edge_margin.value > 0.0) {
    map.polygon(corners_of(mission.operating_area.moved_in(mission.edge_margin)), kWaypoints);
    map.legend(kWaypoints, "way-points", host::formatted("%.0f m from its edges", mission.edge_margin.value));
  }
  if (safety.fence) {
    map.polygon(safety.fence->inside.span(), kInside);
    map.polygon(safety.fence->save.span(), kSave);
    map.polygon(safety.fence->halt.span(), kHalt);
    const bool is_area = std::ranges::is_permutation(safety.fence->inside.span(), corners_of(mission.operating_area));
    map.legend(kInside, is_area ? "inside, on the area's edges" : "inside", "steered back until here");
    map.legend(kSave, "save", "steered back from here");
    map.legend(kHalt, "halt", "aborted from here");
  } else {
    map.polygon(corners_of(mission.operating_area), {kHalt.stroke, "none", kHalt.width, ""});
    map.legend(kHalt, "halt: no fence", "aborted beyond the search area");
  }
  if (!safety.no_surface.empty()) map.legend(kZone, "no surfacing", "but for an abort");
  if (safety.safe_point) {
    map.dot(*safety.safe_point, kSafePoint);
    map.legend(kSafePoint, "safe point");
  }
  return map.svg();
}

}  // namespace earshot::board
