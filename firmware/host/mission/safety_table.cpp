#include "firmware/host/mission/safety_table.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "firmware/config/safety.hpp"
#include "firmware/host/mission/rule_words.hpp"
#include "firmware/safety/check.hpp"
#include "firmware/safety/supervisor.hpp"

namespace earshot::host {
namespace {

using config::Condition;
using config::ConditionTraits;
using config::Polygon;
using config::Rule;
using safety::SafetyComplaint;
using safety::SafetyFault;

constexpr double kFarthest_m = 1e6;  // of a local plane
constexpr std::array<const char*, 3> kTiers{"inside", "save", "halt"};

config::VehicleLimits read_vehicle(TableReader vehicle) {
  config::VehicleLimits limits;
  const auto speed = [&vehicle](const char* key, MetersPerSecond fallback) {
    return MetersPerSecond{vehicle.number_or(key, fallback.value, Range::between(0.0, 20.0))};
  };
  limits.max_speed = speed("max_speed_mps", limits.max_speed);
  limits.max_current = speed("max_current_mps", limits.max_current);
  limits.turn_radius = Meters{vehicle.number_or("turn_radius_m", 0.0, Range::between(0.0, 1000.0))};
  limits.hold_speed = speed("hold_speed_mps", limits.hold_speed);
  limits.ascent_speed = speed("ascent_speed_mps", limits.ascent_speed);
  limits.ascent_rate = MetersPerSecond{vehicle.number_or("ascent_rate_mps", limits.ascent_rate.value,
                                                         Range::between(config::kSlowestAscent.value, config::kFastestAscent.value))};
  limits.surface_depth = Meters{vehicle.number_or("surface_depth_m", limits.surface_depth.value, Range::between(0.1, 10.0))};
  limits.battery_percent_per_km = vehicle.number_or("battery_percent_per_km", 0.0, Range::between(0.0, 100.0));
  return limits;
}

Polygon read_polygon(TableReader& table, const std::string& prefix) {
  const std::string north_key = prefix + "north_m";
  const std::string east_key = prefix + "east_m";
  const std::vector<double> north = table.numbers(north_key, Range::between(-kFarthest_m, kFarthest_m));
  const std::vector<double> east = table.numbers(east_key, Range::between(-kFarthest_m, kFarthest_m));
  Polygon polygon;
  if (table.is_noted(north_key) || table.is_noted(east_key)) return polygon;
  if (north.size() != east.size()) table.problem(east_key, "must have as many numbers as " + north_key + ": a corner has one of each");
  if (north.size() > config::kMaxPolygonCorners)
    table.problem(north_key, "must have at most " + std::to_string(config::kMaxPolygonCorners) + " corners");
  for (std::size_t i = 0; i < std::min({north.size(), east.size(), config::kMaxPolygonCorners}); ++i)
    (void)polygon.push_back({.north = Meters{north[i]}, .east = Meters{east[i]}});
  return polygon;
}

std::vector<TableReader> tables_if_any(TableReader& root, const char* key, std::size_t most,
                                       TableReader::Counted counted = TableReader::Counted::kEverywhere) {
  return root.has(key) ? root.tables(key, most, counted) : std::vector<TableReader>();
}

std::vector<std::string> keys_of(const auto& traits_of_all) {
  std::vector<std::string> keys;
  for (const auto& traits : traits_of_all) keys.emplace_back(traits.key);
  return keys;
}

Rule read_rule(TableReader table) {
  Rule rule;
  rule.condition = static_cast<Condition>(table.choice("when", keys_of(config::kConditionTraits)));
  const ConditionTraits& traits = config::kConditionTraits.at(static_cast<std::size_t>(rule.condition));
  const Range range = Range::between(traits.lowest, traits.highest);
  if (!table.is_noted("when") && traits.kind != ConditionTraits::Kind::kFlag)
    rule.limit = table.number(traits.kind == ConditionTraits::Kind::kAbove ? "above" : "below", range);
  rule.persistence = {std::llround(table.number_or("for_s", 0.0, Range::between(0.0, 86'400.0)) * 1e6)};
  rule.response = static_cast<config::Response>(table.choice("then", keys_of(config::kResponseTraits)));
  rule.is_latched = table.boolean_or("latched", rule.response >= config::Response::kAbort);
  return rule;
}

std::string corner_words(const safety::SafetyComplaint& complaint) {
  const PolygonComplaint& polygon = complaint.polygon;
  switch (polygon.fault) {
    case PolygonFault::kNone:
    case PolygonFault::kNotFinite:
      break;
    case PolygonFault::kTooFewCorners:
      return "a polygon needs three corners or more";
    case PolygonFault::kRepeatedCorner:
      return "corner " + std::to_string(polygon.edge + 1) + " and the next are one place; the last corner is joined to the first by itself";
    case PolygonFault::kCrossesItself:
      return "the polygon crosses or touches itself: the edge after corner " + std::to_string(polygon.edge + 1) +
             " meets the one after corner " + std::to_string(polygon.other + 1);
  }
  return "a corner is no place";
}

void complain_of_ascent(TableReader vehicle, const config::VehicleLimits& limits) {
  if (limits.ascent_speed < config::kSlowestAscent)
    return vehicle.problem("ascent_speed_mps", "must be 0 or at least " + shortly(config::kSlowestAscent.value) +
                                                   ": a vehicle that must move to come up rises no faster than it moves, and one that "
                                                   "rises more slowly is not counted on to come up (ascent_rate_mps)");
  vehicle.problem("ascent_rate_mps", "must be at most vehicle.ascent_speed_mps (" + vehicle.place_of("ascent_speed_mps") + " = " +
                                         shortly(limits.ascent_speed.value) +
                                         "): a vehicle that must move to come up rises no faster than it moves");
}

/// Names both keys, whichever of them was changed.
void complain_of_vehicle(TableReader vehicle, const TableReader& search, const config::Mission& mission) {
  const config::VehicleLimits& limits = mission.safety.vehicle;
  const std::string search_speed = " (" + search.place_of("speed_mps") + " = " + shortly(mission.search_speed.value) + ")";
  if (limits.hold_speed > mission.search_speed)
    return vehicle.problem("hold_speed_mps",
                           "the search must be fast enough to obey the rudders: hold_speed_mps <= search.speed_mps" + search_speed);
  if (limits.ascent_speed > limits.max_speed)
    return vehicle.problem("ascent_speed_mps", "the vehicle must be able to come up: ascent_speed_mps <= max_speed_mps (" +
                                                   vehicle.place_of("max_speed_mps") + " = " + shortly(limits.max_speed.value) + ")");
  if (mission.search_speed > limits.max_speed)
    return vehicle.problem("max_speed_mps", "the vehicle must be as fast as its search: search.speed_mps <= max_speed_mps" + search_speed);
  if (limits.ascent_speed > MetersPerSecond{} && limits.ascent_rate > limits.ascent_speed) return complain_of_ascent(vehicle, limits);
  return vehicle.problem("max_current_mps",
                         "the vehicle must be able to go faster than the current: max_current_mps < search.speed_mps" + search_speed);
}

void complain_of_fence(TableReader fence, const SafetyComplaint& complaint, const config::Mission& mission) {
  switch (complaint.fault) {
    case SafetyFault::kFence:
      return fence.problem(std::string(kTiers.at(complaint.index)) + "_north_m", corner_words(complaint));
    case SafetyFault::kInsideBeyondSave:
      return fence.problem("inside_north_m", "the polygon inside must lie in the save polygon");
    case SafetyFault::kSaveNearHalt:
      return fence.problem("save_north_m", "the save polygon must lie in the halt polygon and keep " +
                                               shortly(std::ceil(safety::margin_to_halt(mission).value)) +
                                               " m from its edges, the way this vehicle may need to turn round");
    default:
      return fence.problem("inside_north_m", "must hold every way-point: area, less edge_margin_m on each side");
  }
}

void complain_of_rule(TableReader rule, const SafetyComplaint& complaint, const config::Mission& mission) {
  switch (complaint.fault) {
    case SafetyFault::kRuleNeedsFence:
      return rule.problem("then", "needs a [fence] to steer back into");
    case SafetyFault::kRuleNeedsSafePoint:
      return rule.problem("when", "needs a [safe_point] to return to");
    case SafetyFault::kRuleNeverActs: {
      const Rule other = safety::rules_of(mission)[complaint.other];
      const bool is_standing = complaint.other < safety::standing_rules(mission);
      return rule.problem("when", "never does anything: another rule does as much, and sooner: " + to_string(other) +
                                      (is_standing ? " (which stands in every mission)" : ""));
    }
    default:
      return rule.problem("when", "has a limit out of its range");
  }
}

}  // namespace

SafetyTables safety_tables(TableReader root) {
  return {.vehicle = root.optional_table("vehicle"),
          .fence = root.optional_table("fence"),
          .no_surface = tables_if_any(root, "no_surface", config::kMaxNoSurfaceZones),
          .safe_point = root.optional_table("safe_point"),
          .rules = tables_if_any(root, "rule", config::kMaxOwnRules, TableReader::Counted::kInFile)};
}

config::Safety read_safety(SafetyTables& tables) {
  config::Safety safety;
  if (tables.vehicle) safety.vehicle = read_vehicle(*tables.vehicle);
  if (tables.fence) {
    safety.fence = config::Fence{.inside = read_polygon(*tables.fence, "inside_"),
                                 .save = read_polygon(*tables.fence, "save_"),
                                 .halt = read_polygon(*tables.fence, "halt_")};
  }
  for (TableReader& zone : tables.no_surface) (void)safety.no_surface.push_back(read_polygon(zone, ""));
  if (tables.safe_point) {
    const Range anywhere = Range::between(-kFarthest_m, kFarthest_m);
    const double north = tables.safe_point->number("north_m", anywhere);
    safety.safe_point = NorthEast{.north = Meters{north}, .east = Meters{tables.safe_point->number("east_m", anywhere)}};
  }
  for (TableReader& rule : tables.rules) (void)safety.rules.push_back(read_rule(rule));
  return safety;
}

void check_safety(SafetyTables& tables, TableReader root, const TableReader& search, const config::Mission& mission) {
  const SafetyComplaint complaint = safety::check(mission);
  switch (complaint.fault) {
    case SafetyFault::kNone:
      return;
    case SafetyFault::kVehicle:
      return complain_of_vehicle(tables.vehicle ? *tables.vehicle : root, search, mission);
    case SafetyFault::kFence:
    case SafetyFault::kInsideBeyondSave:
    case SafetyFault::kSaveNearHalt:
    case SafetyFault::kSearchBeyondFence:
      return complain_of_fence(*tables.fence, complaint, mission);
    case SafetyFault::kZone:
      return tables.no_surface.at(complaint.index).problem("north_m", corner_words(complaint));
    case SafetyFault::kSafePoint:
      return tables.safe_point->problem("north_m", "must lie inside the fence (without one, in the area) and in no zone of [[no_surface]]");
    case SafetyFault::kRuleUnknown:
    case SafetyFault::kRuleLimit:
    case SafetyFault::kRuleNeedsFence:
    case SafetyFault::kRuleNeedsSafePoint:
    case SafetyFault::kRuleNeverActs:
      return complain_of_rule(tables.rules.at(complaint.index), complaint, mission);
  }
}

}  // namespace earshot::host
