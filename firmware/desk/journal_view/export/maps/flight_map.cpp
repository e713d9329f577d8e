#include "firmware/desk/journal_view/export/maps/flight_map.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <variant>

#include "firmware/config/mission.hpp"
#include "firmware/core/compass.hpp"
#include "firmware/desk/journal_view/export/fields.hpp"
#include "firmware/host/journal/words/sentences.hpp"
#include "firmware/host/text/numbers.hpp"
#include "firmware/host/text/utc.hpp"

namespace earshot::journal {
namespace {

using Json = nlohmann::ordered_json;

double rounded(double number, int places) {
  const double scale = std::pow(10.0, places);
  return std::round(number * scale) / scale;
}

void put_place(Json& properties, const std::string& name, const std::optional<MapPlace>& place) {
  constexpr int kCentimetersOfArc = 7;
  properties[name + "_latitude_deg"] = place ? Json(rounded(place->latitude_deg, kCentimetersOfArc)) : Json();
  properties[name + "_longitude_deg"] = place ? Json(rounded(place->longitude_deg, kCentimetersOfArc)) : Json();
}

double distance_m(NorthEast a, NorthEast b) {
  return std::hypot((b - a).north.value, (b - a).east.value);
}

Json direction_deg(NorthEast from, NorthEast to) {
  constexpr int kMillidegrees = 3;
  const NorthEast way = to - from;
  if (way == NorthEast{}) return {};
  return rounded(compass_degrees(Radians{std::atan2(way.east.value, way.north.value)}), kMillidegrees);
}

/// How far it is along a direction of length one until a coordinate leaves its limits.
double way_out(double at, double direction, double least, double most) {
  if (direction == 0.0) return std::numeric_limits<double>::infinity();
  return ((direction > 0.0 ? most : least) - at) / direction;
}

}  // namespace

void FlightMap::take(const Entry& entry) {
  const auto* const record = std::get_if<Record>(&entry);
  if (record == nullptr) return;
  if (!began_) began_ = record->time;
  if (const auto* const mission = std::get_if<messages::MissionRecord>(&record->content)) note(*mission);
  if (const auto* const decision = std::get_if<messages::Decision>(&record->content)) note(*decision, record->content);
  const auto* const input = std::get_if<messages::Input>(&record->content);
  const auto* const fix = input != nullptr ? std::get_if<messages::Navigation>(&input->value) : nullptr;
  if (fix != nullptr && messages::is_usable(*fix)) note(*fix);
}

void FlightMap::note(const messages::MissionRecord& record) {
  const config::Mission& mission = record.mission;
  const Rectangle& area = mission.operating_area;
  operating_area_ = area;
  add_area("operating_area", std::array{area.south_west, NorthEast{area.south_west.north, area.north_east.east}, area.north_east,
                                        NorthEast{area.north_east.north, area.south_west.east}});
  if (mission.safety.fence) {
    add_area("fence_inside", mission.safety.fence->inside.span());
    add_area("fence_save", mission.safety.fence->save.span());
    add_area("fence_halt", mission.safety.fence->halt.span());
  }
  for (const config::Polygon& zone : mission.safety.no_surface) add_area("no_surface_zone", zone.span());
  if (!mission.safety.safe_point) return;
  if (const std::optional<MapPlace> place = map(*mission.safety.safe_point))
    points_.push_back({.kind = "safe_point", .name = "safe point", .words = "", .place = *place, .properties = Json::object()});
}

void FlightMap::note(const messages::Navigation& fix) {
  if (newest_fix_ && fix.time <= newest_fix_->time) return;
  std::optional<MapPlace> place = map(fix.position);
  if (!place) return;
  place->depth_m = fix.depth.value;
  place->time = fix.time;
  newest_fix_ = place;
  if (fixes_++ % fixes_of_a_place_ == 0) keep(*place);
}

void FlightMap::keep(const MapPlace& fix) {
  track_.push_back(fix);
  if (track_.size() < kMostTrackPlaces) return;
  for (std::size_t i = 0; 2 * i < track_.size(); ++i) track_[i] = track_[2 * i];
  track_.resize((track_.size() + 1) / 2);
  fixes_of_a_place_ *= 2;
}

void FlightMap::finish() {
  if (newest_fix_ && newest_fix_->time != track_.back().time) track_.push_back(*newest_fix_);
}

void FlightMap::note(const messages::Decision& decision, const Content& content) {
  ++decisions_;
  const std::optional<MapPlace> place = map_vehicle(decision.position, decision.time);
  if (!place) return;
  constexpr int kMillimeters = 3;
  Json properties{{"mission_s", mission_s(decision.time)}};
  if (host::is_dated(decision.time)) properties["utc"] = host::iso_8601(decision.time);
  properties.update(fields_of(content));
  properties.erase("observation");
  properties.erase("logits");
  properties["depth_m"] = place->has_depth() ? Json(rounded(place->depth_m, kMillimeters)) : Json();
  properties["direction_deg"] = direction_deg(decision.position, decision.waypoint);
  put_place(properties, "waypoint", map(decision.waypoint));
  if (decision.belief) {
    put_place(properties, "likeliest", map(decision.belief->likeliest));
    properties["likeliest_distance_m"] = rounded(distance_m(decision.position, decision.belief->likeliest), kMillimeters);
  }
  const std::string name = "step " + std::to_string(decision.step);
  points_.push_back({.kind = "decision",
                     .name = name,
                     .words = to_string(decision),
                     .place = *place,
                     .has_time = true,
                     .properties = std::move(properties)});
  if (const std::optional<MapPlace> declared = decision.found ? map(decision.found->likeliest) : std::nullopt) {
    points_.push_back({.kind = "declared_place",
                       .name = "source, declared at " + name,
                       .words = "",
                       .place = *declared,
                       .properties = {{"step", decision.step}, {"found_probability", decision.found->probability}}});
  }
  if (!decision.bearing || !messages::is_possible(*decision.bearing)) return;
  const messages::Bearing& bearing = *decision.bearing;
  add_ray(decision, bearing.direction, false);
  if (bearing.mirror_axis) add_ray(decision, Radians{2.0 * bearing.mirror_axis->value - bearing.direction.value}, true);
}

void FlightMap::add_area(std::string kind, std::span<const NorthEast> corners) {
  Area area{.kind = std::move(kind), .corners = {}};
  for (const NorthEast corner : corners) {
    const std::optional<MapPlace> place = map(corner);
    if (!place) return;
    area.corners.push_back(*place);
  }
  areas_.push_back(std::move(area));
}

void FlightMap::add_ray(const messages::Decision& decision, Radians direction, bool is_mirror) {
  if (!operating_area_ || !operating_area_->contains(decision.position)) return;
  const double north = std::cos(direction.value);
  const double east = std::sin(direction.value);
  const NorthEast& from = decision.position;
  const Rectangle& area = *operating_area_;
  const double length_m = std::min(way_out(from.north.value, north, area.south_west.north.value, area.north_east.north.value),
                                   way_out(from.east.value, east, area.south_west.east.value, area.north_east.east.value));
  if (!(length_m > 0.0)) return;
  const std::optional<MapPlace> near = map(from);
  const std::optional<MapPlace> far = map(from + NorthEast{Meters{north * length_m}, Meters{east * length_m}});
  if (!near || !far) return;
  rays_.push_back({.step = decision.step, .direction_deg = compass_degrees(direction), .is_mirror = is_mirror, .ends = {*near, *far}});
}

std::optional<MapPlace> FlightMap::map(NorthEast place) {
  const std::optional<MapPlace> on_map = place_of(place, plane_);
  if (!on_map) ++out_of_reach_;
  return on_map;
}

std::optional<MapPlace> FlightMap::map_vehicle(NorthEast place, Time time) {
  std::optional<MapPlace> on_map = map(place);
  if (!on_map) return on_map;
  on_map->time = time;
  if (newest_fix_) on_map->depth_m = newest_fix_->depth_m;
  return on_map;
}

std::string FlightMap::what() const {
  std::string text = host::counted(decisions_, "decision") + ", a track of " + host::counted(track_.size(), "place");
  if (fixes_of_a_place_ > 1) text += ", one for every " + std::to_string(fixes_of_a_place_) + " fixes";
  if (out_of_reach_ > 0) text += "; left out: " + host::counted(out_of_reach_, "place") + " more than 2 degrees from the origin";
  return text;
}

}  // namespace earshot::journal
