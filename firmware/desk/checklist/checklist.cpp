#include "firmware/desk/checklist/checklist.hpp"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include "firmware/config/capacities.hpp"
#include "firmware/desk/checklist/budgets.hpp"
#include "firmware/host/file/printable.hpp"
#include "firmware/host/mission/rule_words.hpp"
#include "firmware/host/text/duration.hpp"
#include "firmware/host/text/numbers.hpp"
#include "firmware/runtime/runtime.hpp"
#include "firmware/safety/supervisor.hpp"

namespace earshot::board {
namespace {

constexpr std::size_t kNameWidth = 11;
/// "  depth       300 m, and never below 400 m"
std::string row(std::string_view what, const std::string& value) {
  std::string name(what);
  name.resize(std::max(name.size(), kNameWidth), ' ');
  return "  " + name + " " + value + "\n";
}

std::string roles_of(const host::PortSettings& port) {
  constexpr std::array<std::pair<host::Role, const char*>, host::kRoleCount> kWords{{{host::Role::kNavigation, "navigation"},
                                                                                     {host::Role::kSnr, "snr"},
                                                                                     {host::Role::kOperator, "operator"},
                                                                                     {host::Role::kAutopilot, "autopilot"},
                                                                                     {host::Role::kStatus, "status"},
                                                                                     {host::Role::kHydrophone, "hydrophone"}}};
  std::string text;
  for (const auto& [role, word] : kWords) {
    if (port.roles.has(role)) text += (text.empty() ? "" : ", ") + std::string(word);
  }
  return text;
}

std::string signer(const std::filesystem::path& key) {
  return host::printable(key.lexically_normal().string());
}

/// "20 Hz, the vehicle at 300 m, 96 oceans as far as 35.4 km"
std::string sound_of(const policy::OceanTables& tables) {
  return host::significant(tables.frequency.value, 6) + " Hz, the vehicle at " + host::significant(tables.receiver_depth.value, 6) +
         " m, " + host::counted(tables.tables.size(), "ocean") + " as far as " + host::decimals(policy::reach(tables).value / 1e3, 1) +
         " km";
}

std::string oceans(const host::SignedSearch& search, const Signatures& signatures) {
  if (search.tables_file.empty()) return row("tables", "none, the policy does not search by them");
  return row("tables", host::printable(search.tables_file.lexically_normal().string()) + ": " + sound_of(*search.tables.tables)) +
         row("signed by", signer(signatures.tables));
}

std::string files(const host::MissionFile& file, const host::SignedSearch& search, const std::string& shown, const Signatures& signatures) {
  const policy::FrozenPolicy& policy = *search.policy.policy;
  const std::string mission_signer = signatures.mission.empty()
                                         ? "nobody; no signature is asked for"
                                         : signer(signatures.mission) + ", counter " + std::to_string(signatures.counter);
  return "files\n" + row("mission", host::printable(shown)) + row("signed by", mission_signer) +
         row("policy", host::printable(file.policy.lexically_normal().string()) + ": " + std::to_string(policy.actions.size()) +
                           " directions, an observation of " + std::to_string(policy.observation.spec.size()) + " numbers") +
         row("signed by", signer(signatures.policy)) + oceans(search, signatures);
}

/// "for auv-7, with the mark of who knows the key in vehicle.key; ABORT of anybody"
std::string orders(const host::MissionFile& file) {
  if (!file.command_key) return "of anybody on the bus";
  const std::string name = host::vehicle_id_of(file.challenge);
  return "for " + (name.empty() ? "a vehicle without a name (vehicle_id)" : host::printable(name)) +
         ", with the mark of who knows the key in " + host::printable(file.command_key_file.lexically_normal().string()) +
         "; ABORT of anybody" + (file.accepts_old_marks ? "; marks without the challenge count, too" : "");
}

std::string authority(const host::MissionFile& file) {
  const Duration timeout = file.mission.authority.autopilot_timeout;
  return "authority\n" + row("orders", orders(file)) +
         row("START", timeout > Duration{} ? host::formatted("waits for an autopilot's status no older than %g s", timeout.to_seconds())
                                           : "waits for no autopilot's status");
}

std::string ports(const host::MissionFile& file) {
  std::string text = "ports (none was opened)\n";
  for (const host::PortSettings& port : file.ports) {
    const char* const kind = port.kind == host::PortKind::kCan ? "CAN " : "LCM ";
    text += row(host::printable(port.name), kind + host::printable(port.address) + ": " + roles_of(port));
  }
  return text;
}

std::string set_points(const host::MissionFile& file) {
  const std::string period = host::formatted("%g s", file.step_period.to_seconds());
  if (file.turns == host::Turns::kPeriodic) return "every " + period;
  return host::formatted("at once on every fix and order, at most %.0f a second; in silence every ", 1e6 / config::kLeastBetweenTurns_us) +
         period;
}

std::string search(const host::MissionFile& file) {
  const config::Mission& mission = file.mission;
  const NorthEast size = mission.operating_area.north_east - mission.operating_area.south_west;
  return "search\n" +
         row("area", host::formatted("%.1f km x %.1f km, way-points %.0f m from its edges", size.north.value * 1e-3, size.east.value * 1e-3,
                                     mission.edge_margin.value)) +
         row("depth", host::formatted("%.1f m, and never below %.1f m", mission.search_depth.value, mission.max_depth.value)) +
         row("steps", host::formatted("%u of %.0f m at %.2f m/s", static_cast<unsigned>(mission.max_steps), mission.step_length.value,
                                      mission.search_speed.value)) +
         row("set-points", set_points(file));
}

/// "by going round at 1.00 m/s, rising at least 0.10 m/s; it is up at 2.0 m or less; from 400 m within 1 h 08 min"
std::string way_up(const config::Mission& mission) {
  const config::VehicleLimits& v = mission.safety.vehicle;
  constexpr double kTimeToTurnUp_s = 60.0;
  if (!(v.ascent_speed > MetersPerSecond{})) return "floats up by itself";
  return host::formatted("by going round at %.2f m/s, rising at least %.2f m/s; it is up at %.1f m or less; from %.0f m within ",
                         v.ascent_speed.value, v.ascent_rate.value, v.surface_depth.value, mission.max_depth.value) +
         host::duration(mission.max_depth.value / v.ascent_rate.value + kTimeToTurnUp_s);
}

std::string vehicle(const config::Mission& mission) {
  const config::VehicleLimits& v = mission.safety.vehicle;
  return "vehicle (from [vehicle], or what stands in its place)\n" +
         row("speed", host::formatted("at most %.2f m/s through the water, in a current of at most %.2f m/s", v.max_speed.value,
                                      v.max_current.value)) +
         row("turns", host::formatted("within a radius of %.0f m", v.turn_radius.value)) +
         row("holds",
             v.hold_speed > MetersPerSecond{} ? host::formatted("its place by going round at %.2f m/s", v.hold_speed.value) : "hovers") +
         row("comes up", way_up(mission));
}

std::string extent_of(const config::Polygon& polygon) {
  NorthEast least = polygon[0];
  NorthEast most = polygon[0];
  for (const NorthEast& corner : polygon.span()) {
    least = {std::min(least.north, corner.north), std::min(least.east, corner.east)};
    most = {std::max(most.north, corner.north), std::max(most.east, corner.east)};
  }
  return host::formatted("%zu corners, from %.0f to %.0f m north and %.0f to %.0f m east", polygon.size(), least.north.value,
                         most.north.value, least.east.value, most.east.value);
}

std::string places(const config::Mission& mission) {
  const config::Safety& safety = mission.safety;
  std::string text = "places (from the origin)\n";
  if (safety.fence) {
    text += row("inside", extent_of(safety.fence->inside)) + row("save", extent_of(safety.fence->save)) +
            row("halt", extent_of(safety.fence->halt));
  } else {
    text += row("fence", "none: the search is aborted beyond its area");
  }
  if (safety.safe_point)
    text += row("safe point", host::formatted("%.0f m north, %.0f m east", safety.safe_point->north.value, safety.safe_point->east.value));
  for (const config::Polygon& zone : safety.no_surface) text += row("no surface", extent_of(zone));
  return text;
}

std::string energy(const config::Mission& mission) {
  if (mission.safety.vehicle.battery_percent_per_km == 0.0) return "not known: vehicle.battery_percent_per_km is not given";
  std::string text = host::formatted("%.1f %% of the battery for all steps in still water", percent_for_all_steps(mission));
  if (mission.safety.safe_point)
    text += host::formatted(", %.1f %% for the longest way home against the current", percent_for_way_home(mission));
  return text;
}

std::string budgets(const config::Mission& mission) {
  std::string time = host::duration(seconds_for_all_steps(mission)) + " for all steps in still water";
  if (mission.safety.vehicle.max_current > MetersPerSecond{})
    time += ", " + host::duration(seconds_against_current(mission)) + " against the current all along";
  std::string way = host::formatted("%.1f km for all steps", way_of_all_steps(mission).value * 1e-3);
  if (mission.safety.safe_point) way += host::formatted(", %.1f km for the longest way home", longest_way_home(mission).value * 1e-3);
  return "budgets\n" + row("time", time + "; the search ends after " + host::duration(mission.max_time.to_seconds())) + row("way", way) +
         row("energy", energy(mission));
}

/// What a rule does, and what it must do before.
std::string sentence_of(const config::Rule& rule, const config::Mission& mission) {
  const bool leaves_first = rule.response == config::Response::kSurface && !mission.safety.no_surface.empty();
  return host::sentence_of(rule) + (leaves_first ? "; in a zone of no_surface it leaves that before it comes up" : "");
}

std::string rules(const config::Mission& mission) {
  const std::size_t standing = safety::standing_rules(mission);
  std::string text =
      "rules (the first " + std::to_string(standing) + " stand in every mission like this one, and nothing takes them off)\n";
  std::size_t number = 0;
  for (const config::Rule& rule : safety::rules_of(mission))
    text += host::formatted("  %2zu  ", ++number) + sentence_of(rule, mission) + "\n";
  return text;
}

}  // namespace

std::string checklist(const host::MissionFile& file, const host::SignedSearch& with, const std::string& shown,
                      const Signatures& signatures) {
  return files(file, with, shown, signatures) + ports(file) + authority(file) + vehicle(file.mission) + search(file) +
         places(file.mission) + budgets(file.mission) + rules(file.mission) + "memory\n" +
         row("runtime", std::to_string(sizeof(runtime::Runtime)) + " bytes, of " + std::to_string(config::kRuntimeBytes) + " allowed");
}

}  // namespace earshot::board
