#include "firmware/wire/lcm/safety_conversion.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>

namespace earshot::wire {
namespace {

// Places of the polygons in a mission_t.
constexpr std::size_t kInside = 0;
constexpr std::size_t kSave = 1;
constexpr std::size_t kHalt = 2;
constexpr std::size_t kFirstZone = 3;

static_assert(std::size(mission_t{}.corners) == kFirstZone + config::kMaxNoSurfaceZones);
static_assert(std::size(mission_t{}.corner_north_m[0]) == config::kMaxPolygonCorners);
static_assert(std::size(mission_t{}.rule_limit) == config::kMaxOwnRules);

void put_polygon(const config::Polygon& polygon, std::size_t place, mission_t& m) {
  m.corners[place] = static_cast<std::int8_t>(polygon.size());
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    m.corner_north_m[place][i] = polygon[i].north.value;
    m.corner_east_m[place][i] = polygon[i].east.value;
  }
}

config::Polygon polygon_at(std::size_t place, const mission_t& m) {
  config::Polygon polygon;
  const auto corners = static_cast<std::size_t>(std::clamp<int>(m.corners[place], 0, config::kMaxPolygonCorners));
  for (std::size_t i = 0; i < corners; ++i) {
    const NorthEast corner{.north = Meters{m.corner_north_m[place][i]}, .east = Meters{m.corner_east_m[place][i]}};
    static_cast<void>(polygon.push_back(corner));  // there is room
  }
  return polygon;
}

void put_rules(const config::Safety& safety, mission_t& m) {
  m.rules = static_cast<std::int8_t>(safety.rules.size());
  for (std::size_t i = 0; i < safety.rules.size(); ++i) {
    const config::Rule& rule = safety.rules[i];
    m.rule_condition[i] = static_cast<std::int8_t>(rule.condition);
    m.rule_limit[i] = rule.limit;
    m.rule_persistence_us[i] = rule.persistence.us;
    m.rule_response[i] = static_cast<std::int8_t>(rule.response);
    m.rule_latched[i] = rule.is_latched ? 1 : 0;
  }
}

}  // namespace

void put_safety(const config::Safety& safety, mission_t& m) {
  if (safety.fence) {
    put_polygon(safety.fence->inside, kInside, m);
    put_polygon(safety.fence->save, kSave, m);
    put_polygon(safety.fence->halt, kHalt, m);
  }
  for (std::size_t i = 0; i < safety.no_surface.size(); ++i) put_polygon(safety.no_surface[i], kFirstZone + i, m);
  m.has_safe_point = safety.safe_point ? 1 : 0;
  if (safety.safe_point) {
    m.safe_point_north_m = safety.safe_point->north.value;
    m.safe_point_east_m = safety.safe_point->east.value;
  }
  m.vehicle_max_speed_mps = safety.vehicle.max_speed.value;
  m.vehicle_max_current_mps = safety.vehicle.max_current.value;
  m.vehicle_turn_radius_m = safety.vehicle.turn_radius.value;
  m.vehicle_hold_speed_mps = safety.vehicle.hold_speed.value;
  m.vehicle_ascent_speed_mps = safety.vehicle.ascent_speed.value;
  m.vehicle_ascent_rate_mps = safety.vehicle.ascent_rate.value;
  m.vehicle_surface_depth_m = safety.vehicle.surface_depth.value;
  m.vehicle_battery_percent_per_km = safety.vehicle.battery_percent_per_km;
  put_rules(safety, m);
}

config::Safety safety_in(const mission_t& m) {
  config::Safety safety;
  if (m.corners[kInside] > 0)
    safety.fence = config::Fence{.inside = polygon_at(kInside, m), .save = polygon_at(kSave, m), .halt = polygon_at(kHalt, m)};
  for (std::size_t i = kFirstZone; i < std::size(m.corners) && m.corners[i] > 0; ++i)
    static_cast<void>(safety.no_surface.push_back(polygon_at(i, m)));
  if (m.has_safe_point != 0) safety.safe_point = NorthEast{Meters{m.safe_point_north_m}, Meters{m.safe_point_east_m}};
  safety.vehicle = {.max_speed = MetersPerSecond{m.vehicle_max_speed_mps},
                    .max_current = MetersPerSecond{m.vehicle_max_current_mps},
                    .turn_radius = Meters{m.vehicle_turn_radius_m},
                    .hold_speed = MetersPerSecond{m.vehicle_hold_speed_mps},
                    .ascent_speed = MetersPerSecond{m.vehicle_ascent_speed_mps},
                    .ascent_rate = MetersPerSecond{m.vehicle_ascent_rate_mps},
                    .surface_depth = Meters{m.vehicle_surface_depth_m},
                    .battery_percent_per_km = m.vehicle_battery_percent_per_km};
  const auto rules = static_cast<std::size_t>(std::clamp<int>(m.rules, 0, config::kMaxOwnRules));
  for (std::size_t i = 0; i < rules; ++i) {
    const config::Rule rule{.condition = static_cast<config::Condition>(m.rule_condition[i]),
                            .limit = m.rule_limit[i],
                            .persistence = {m.rule_persistence_us[i]},
                            .response = static_cast<config::Response>(m.rule_response[i]),
                            .is_latched = m.rule_latched[i] != 0};
    static_cast<void>(safety.rules.push_back(rule));  // there is room
  }
  return safety;
}

}  // namespace earshot::wire
