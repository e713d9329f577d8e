#include "firmware/boards/linux/checklist/checklist.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <string_view>
#include <utility>

#include "firmware/boards/linux/checklist/formatted.hpp"
#include "firmware/host/file/printable.hpp"
#include "firmware/host/mission/rule_words.hpp"
#include "firmware/runtime/runtime.hpp"
#include "firmware/safety/measures.hpp"
#include "firmware/safety/supervisor.hpp"

namespace earshot::board {
namespace {

constexpr std::size_t kNameWidth = 11;
/// By so much a vehicle that keeps its depth is deeper now and then.
constexpr Meters kDepthRoom{2.0};

/// "  depth       300 m, and never below 400 m"
std::string row(std::string_view what, const std::string& value) {
  std::string name(what);
  name.resize(std::max(name.size(), kNameWidth), ' ');
  return "  " + name + " " + value + "\n";
}

/// "13 h 53 min"
std::string in_hours(double seconds) {
  const auto minutes = static_cast<long long>(std::llround(seconds / 60.0));
  if (minutes < 1) return formatted("%.0f s", seconds);
  return minutes < 60 ? formatted("%lld min", minutes) : formatted("%lld h %02lld min", minutes / 60, minutes % 60);
}

double longest_way_m(const config::Mission& mission) {
  return mission.step_length.value * mission.max_steps;
}

double shortest_time_s(const config::Mission& mission) {
  return longest_way_m(mission) / mission.search_speed.value;
}

/// Over ground, from the farthest corner of the search area to the safe point.
double longest_way_home_m(const config::Mission& mission) {
  double longest = 0.0;
  const Rectangle& r = mission.operating_area;
  for (const NorthEast corner :
       {r.south_west, NorthEast{r.north_east.north, r.south_west.east}, r.north_east, NorthEast{r.south_west.north, r.north_east.east}})
    longest = std::max(longest, range_between(corner, *mission.safety.safe_point).value);
  return longest;
}

double percent_for(const config::Mission& mission, double way_m) {
  return way_m * 1e-3 * mission.safety.vehicle.battery_percent_per_km;
}

double percent_for_way_home(const config::Mission& mission) {
  return percent_for(mission, safety::against_current(mission, Meters{longest_way_home_m(mission)}).value);
}

bool has_rule_about(const config::Mission& mission, config::Condition condition) {
  return std::ranges::any_of(mission.safety.rules, [condition](const config::Rule& rule) { return rule.condition == condition; });
}

/// What a battery is doubted for; empty: it is not.
std::string battery_doubt(const config::Mission& mission) {
  const double steps_percent = percent_for(mission, longest_way_m(mission));
  if (steps_percent > 100.0) return formatted("all steps need %.0f %% of a battery", steps_percent);
  if (!mission.safety.safe_point) return {};
  const double percent = steps_percent + percent_for_way_home(mission);
  return percent > 100.0 ? formatted("all steps and the longest way home need %.0f %% of a battery", percent) : std::string();
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

std::string files(const host::MissionFile& file, const policy::FrozenPolicy& policy, const std::string& shown) {
  return "files\n" + row("mission", host::printable(shown)) +
         row("policy", host::printable(file.policy.lexically_normal().string()) + ": " + std::to_string(policy.actions.size()) +
                           " directions, an observation of " + std::to_string(policy.observation.spec.size()) + " numbers") +
         row("signed by", host::printable(file.public_key.lexically_normal().string())) +
         row("orders", file.command_key ? "must bear the mark of the command key" : "of anybody on the bus");
}

std::string ports(const host::MissionFile& file) {
  std::string text = "ports (none was opened)\n";
  for (const host::PortSettings& port : file.ports) {
    const char* const kind = port.kind == host::PortKind::kCan ? "CAN " : "LCM ";
    text += row(host::printable(port.name), kind + host::printable(port.address) + ": " + roles_of(port));
  }
  return text;
}

std::string search(const config::Mission& mission) {
  const NorthEast size = mission.operating_area.north_east - mission.operating_area.south_west;
  return "search\n" +
         row("area", formatted("%.1f km x %.1f km, way-points %.0f m from its edges", size.north.value * 1e-3, size.east.value * 1e-3,
                               mission.edge_margin.value)) +
         row("depth", formatted("%.1f m, and never below %.1f m", mission.search_depth.value, mission.max_depth.value)) +
         row("steps", formatted("%u of %.0f m at %.2f m/s", static_cast<unsigned>(mission.max_steps), mission.step_length.value,
                                mission.search_speed.value));
}

std::string energy(const config::Mission& mission) {
  if (mission.safety.vehicle.battery_percent_per_km == 0.0) return "not known: vehicle.battery_percent_per_km is not given";
  std::string text = formatted("%.1f %% of the battery for all steps in still water", percent_for(mission, longest_way_m(mission)));
  if (mission.safety.safe_point) text += formatted(", %.1f %% for the longest way home against the current", percent_for_way_home(mission));
  return text;
}

std::string budgets(const config::Mission& mission) {
  std::string text = "budgets\n";
  text += row("time", in_hours(shortest_time_s(mission)) + " for all steps in still water; the search ends after " +
                          in_hours(mission.max_time.to_seconds()));
  std::string way = formatted("%.1f km for all steps", longest_way_m(mission) * 1e-3);
  if (mission.safety.safe_point) way += formatted(", %.1f km for the longest way home", longest_way_home_m(mission) * 1e-3);
  text += row("way", way);
  return text + row("energy", energy(mission));
}

std::string rules(const config::Mission& mission) {
  const std::size_t standing = safety::standing_rules(mission);
  std::string text =
      "rules (the first " + std::to_string(standing) + " stand in every mission like this one, and nothing takes them off)\n";
  std::size_t number = 0;
  for (const config::Rule& rule : safety::rules_of(mission)) text += formatted("  %2zu  ", ++number) + host::in_words(rule) + "\n";
  return text;
}

}  // namespace

std::string checklist(const host::MissionFile& file, const policy::FrozenPolicy& policy, const std::string& shown) {
  return files(file, policy, shown) + ports(file) + search(file.mission) + budgets(file.mission) + rules(file.mission) + "memory\n" +
         row("runtime", std::to_string(sizeof(runtime::Runtime)) + " bytes, of " + std::to_string(config::kRuntimeBytes) + " allowed");
}

std::vector<std::string> doubts_about(const host::MissionFile& file) {
  const config::Mission& mission = file.mission;
  std::vector<std::string> doubts;
  const auto doubt_if = [&doubts](bool is_so, const std::string& words) {
    if (is_so) doubts.push_back(words);
  };
  doubt_if(!mission.safety.fence,
           "there is no [fence]: nothing steers the vehicle back before it leaves the area, and that ends the mission");
  doubt_if(mission.safety.vehicle == config::VehicleLimits{},
           "there is no [vehicle]: fixes are believed that only 20 m/s can explain, and the vehicle is taken to hover and to float up by "
           "itself");
  const Meters room = mission.max_depth - mission.search_depth;
  doubt_if(room < kDepthRoom,
           formatted("search.depth_m is %g m above limits.max_depth_m: a vehicle that is deeper than that for 5 s is aborted; leave %g m",
                     room.value, kDepthRoom.value));
  doubt_if(shortest_time_s(mission) > mission.max_time.to_seconds(), "limits.max_time_s is over before all steps are taken");
  const std::string battery = battery_doubt(mission);
  doubt_if(!battery.empty(), battery);
  const bool watches_way_home = has_rule_about(mission, config::Condition::kBatteryAtHome);
  doubt_if(!watches_way_home && !has_rule_about(mission, config::Condition::kBattery), "no rule watches the battery");
  doubt_if(watches_way_home && mission.safety.vehicle.battery_percent_per_km == 0.0,
           "vehicle.battery_percent_per_km is not given: battery_at_home_percent counts no way home");
  const bool is_deafness_told =
      std::ranges::any_of(file.ports, [](const host::PortSettings& port) { return port.roles.has(host::Role::kSnr); });
  doubt_if(!is_deafness_told && has_rule_about(mission, config::Condition::kHydrophoneDeaf),
           "no port has the role \"snr\", the only one that tells of hydrophone_deaf: the rule about it never acts");
  doubt_if(!file.command_key, "there is no authority.key_file: anybody on the bus may command the vehicle");
  for (const host::PortSettings& port : file.ports) {
    std::error_code error;
    const bool is_missing = port.kind == host::PortKind::kCan && !std::filesystem::exists("/sys/class/net/" + port.address, error);
    doubt_if(is_missing, "this computer has no interface " + host::printable(port.address) + " now");
  }
  return doubts;
}

}  // namespace earshot::board
