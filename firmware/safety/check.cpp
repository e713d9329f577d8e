#include "firmware/safety/check.hpp"

#include <algorithm>
#include <array>
#include <optional>

#include "firmware/core/math.hpp"
#include "firmware/safety/fence.hpp"
#include "firmware/safety/supervisor.hpp"

namespace earshot::safety {
namespace {

using config::Condition;
using config::ConditionTraits;
using config::Polygon;
using config::Response;
using config::Rule;

constexpr double kHalfPi = 1.5707963267948966;
constexpr Meters kDeepestSurface{10.0};
constexpr Duration kLongestPersistence = Duration::seconds(86'400);

bool is_usable(const config::VehicleLimits& vehicle, MetersPerSecond search_speed) {
  const auto is_length = [](double value) { return is_finite(value) && value >= 0.0; };
  const std::array values{vehicle.max_speed.value,  vehicle.max_current.value,  vehicle.turn_radius.value,
                          vehicle.hold_speed.value, vehicle.ascent_speed.value, vehicle.battery_percent_per_km};
  return std::all_of(values.begin(), values.end(), is_length) && vehicle.max_speed >= search_speed && vehicle.max_current < search_speed &&
         vehicle.hold_speed <= search_speed && vehicle.ascent_speed <= vehicle.max_speed && vehicle.ascent_rate >= config::kSlowestAscent &&
         vehicle.ascent_rate <= config::kFastestAscent &&
         (vehicle.ascent_speed.value == 0.0 || vehicle.ascent_rate <= vehicle.ascent_speed) && vehicle.surface_depth > Meters{0.0} &&
         vehicle.surface_depth <= kDeepestSurface;
}

const Polygon& polygon_of(const config::Fence& fence, std::size_t index) {
  if (index == 0) return fence.inside;
  return index == 1 ? fence.save : fence.halt;
}

std::array<NorthEast, 4> corners_of(const Rectangle& r) {
  return {r.south_west, NorthEast{.north = r.north_east.north, .east = r.south_west.east}, r.north_east,
          NorthEast{.north = r.south_west.north, .east = r.north_east.east}};
}

SafetyComplaint check_fence(const config::Mission& mission) {
  const config::Fence& fence = *mission.safety.fence;
  for (std::size_t i = 0; i < 3; ++i) {
    const PolygonComplaint complaint = check_polygon(polygon_of(fence, i).span());
    if (!complaint.is_none()) return {.fault = SafetyFault::kFence, .index = i, .polygon = complaint};
  }
  if (!keeps_within(fence.inside.span(), fence.save.span(), Meters{0.0})) return {.fault = SafetyFault::kInsideBeyondSave};
  if (!keeps_within(fence.save.span(), fence.halt.span(), margin_to_halt(mission))) return {.fault = SafetyFault::kSaveNearHalt};
  const auto waypoints = corners_of(mission.operating_area.moved_in(mission.edge_margin));
  if (!keeps_within(waypoints, fence.inside.span(), Meters{0.0})) return {.fault = SafetyFault::kSearchBeyondFence};
  return {};
}

SafetyComplaint check_places(const config::Mission& mission) {
  const config::Safety& safety = mission.safety;
  if (safety.fence) {
    if (const SafetyComplaint complaint = check_fence(mission); !complaint.is_none()) return complaint;
  }
  for (std::size_t i = 0; i < safety.no_surface.size(); ++i) {
    const PolygonComplaint complaint = check_polygon(safety.no_surface[i].span());
    if (!complaint.is_none()) return {.fault = SafetyFault::kZone, .index = i, .polygon = complaint};
  }
  if (!safety.safe_point) return {};
  const NorthEast place = *safety.safe_point;
  const bool is_inside = safety.fence ? contains(safety.fence->inside.span(), place) : mission.operating_area.contains(place);
  const bool may_surface = std::none_of(safety.no_surface.begin(), safety.no_surface.end(),
                                        [place](const Polygon& zone) { return contains(zone.span(), place); });
  return is_inside && may_surface ? SafetyComplaint{} : SafetyComplaint{.fault = SafetyFault::kSafePoint};
}

bool is_in_range(const Rule& rule) {
  const ConditionTraits& traits = config::kConditionTraits[static_cast<std::size_t>(rule.condition)];
  return rule.limit >= traits.lowest && rule.limit <= traits.highest && rule.persistence >= Duration{} &&
         rule.persistence <= kLongestPersistence;
}

/// Whether `sooner` acts whenever `rule` does, and does as much.
bool takes_the_place_of(const Rule& sooner, const Rule& rule) {
  if (sooner.condition != rule.condition || sooner.response < rule.response || sooner.persistence > rule.persistence) return false;
  if (rule.is_latched && !sooner.is_latched) return false;
  const bool is_below = config::kConditionTraits[static_cast<std::size_t>(rule.condition)].kind == ConditionTraits::Kind::kBelow;
  return is_below ? sooner.limit >= rule.limit : sooner.limit <= rule.limit;
}

SafetyFault fault_of(const Rule& rule, const config::Safety& safety) {
  const bool is_known =
      static_cast<std::size_t>(rule.condition) < config::kConditions && static_cast<std::size_t>(rule.response) < config::kResponses;
  if (!is_known) return SafetyFault::kRuleUnknown;
  if (!is_in_range(rule)) return SafetyFault::kRuleLimit;
  const bool needs_fence = rule.response == Response::kSteerBack || rule.condition == Condition::kOutsideFence;
  if (needs_fence && !safety.fence) return SafetyFault::kRuleNeedsFence;
  const bool needs_home = rule.response == Response::kReturn || rule.condition == Condition::kBatteryAtHome;
  return needs_home && !safety.safe_point ? SafetyFault::kRuleNeedsSafePoint : SafetyFault::kNone;
}

SafetyComplaint check_rules(const config::Mission& mission) {
  const config::Safety& safety = mission.safety;
  for (std::size_t i = 0; i < safety.rules.size(); ++i) {
    const SafetyFault fault = fault_of(safety.rules[i], safety);
    if (fault != SafetyFault::kNone) return {.fault = fault, .index = i};
  }
  const Rules all = rules_of(mission);
  const std::size_t standing = standing_rules(mission);
  for (std::size_t i = 0; i < safety.rules.size(); ++i) {
    for (std::size_t j = 0; j < all.size(); ++j) {
      if (j != standing + i && takes_the_place_of(all[j], safety.rules[i]))
        return {.fault = SafetyFault::kRuleNeverActs, .index = i, .other = j};
    }
  }
  return {};
}

}  // namespace

Meters margin_to_halt(const config::Mission& mission) {
  const config::VehicleLimits& vehicle = mission.safety.vehicle;
  const double straight_s = mission.navigation_timeout.to_seconds() + kReaction.to_seconds();
  const double k = vehicle.max_current / mission.search_speed;
  const double turning_m = vehicle.turn_radius.value * (1.0 + kHalfPi * k + 0.571 * k * k);
  const double along_edge_m = vehicle.turn_radius.value * (1.0 + kHalfPi * k);
  const double straight_m = (mission.search_speed + vehicle.max_current).value * straight_s;
  return Meters{std::max(straight_m, along_edge_m) + turning_m};
}

SafetyComplaint check(const config::Mission& mission) {
  if (!is_usable(mission.safety.vehicle, mission.search_speed)) return {.fault = SafetyFault::kVehicle};
  if (const SafetyComplaint complaint = check_places(mission); !complaint.is_none()) return complaint;
  return check_rules(mission);
}

}  // namespace earshot::safety
