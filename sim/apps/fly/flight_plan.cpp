#include "sim/apps/fly/flight_plan.hpp"

#include <sstream>
#include <string>

#include "firmware/host/mission/mission_verifier.hpp"
#include "firmware/host/toml/table_reader.hpp"
#include "firmware/host/trust/vehicle_file.hpp"
#include "sim/ocean/section_along.hpp"
#include "sim/search/scenario/scenario_file.hpp"

namespace earshot::fly {
namespace {

using host::BadInput;

search::SearchSettings settings_of(const config::Mission& mission, const ocean::Environment& environment) {
  search::SearchSettings settings;
  settings.domain = mission.operating_area;
  settings.start_region = mission.operating_area;
  settings.source = environment.source.position;
  settings.step_length = mission.step_length;
  settings.max_steps = mission.max_steps;
  settings.detection_threshold = mission.detection_threshold;
  settings.listening = mission.listening;
  return settings;
}

/// @param whose  what the sea floor is called that the depth is above
void require_depth_in_water(const std::filesystem::path& mission, Meters depth, Meters floor, const std::string& whose) {
  if (depth < floor) return;
  std::ostringstream text;
  text << mission.string() << ": search.depth_m = " << depth.value << ": must be less than " << floor.value << ", " << whose;
  throw BadInput(text.str());
}

}  // namespace

FlightPlan load_flight_plan(const std::filesystem::path& mission, const std::filesystem::path& environment,
                            const std::optional<std::filesystem::path>& vehicle) {
  host::MissionVerifier verifier =
      vehicle ? host::MissionVerifier(host::load_vehicle(*vehicle), host::Counting::kOnlyRead) : host::MissionVerifier();
  FlightPlan plan{.mission = verifier.load_mission(mission), .scenario = search::load_scenario(environment), .search = {}};
  if (!ocean::is_range_independent(plan.scenario.environment))
    throw BadInput(environment.string() + ": its ocean changes with range or bearing, and a flight needs one that does not");
  const Meters depth = plan.mission.mission.search_depth;
  require_depth_in_water(mission, depth, plan.scenario.environment.seabed.depth, "the seabed.depth_m of " + environment.string());
  for (const ocean::Environment& other : plan.scenario.other_oceans)
    require_depth_in_water(mission, depth, other.seabed.depth,
                           "the sea floor of " + other.name + " among the other oceans of " + environment.string());
  plan.search = settings_of(plan.mission.mission, plan.scenario.environment);
  if (search::check(plan.search) != Status::kOk)
    throw BadInput(mission.string() + ": area: no start is further than search.step_length_m from the source");
  return plan;
}

void require_known_consumption(const config::Mission& mission, const std::filesystem::path& path) {
  if (mission.safety.vehicle.battery_percent_per_km > 0.0) return;
  throw BadInput("--battery-percent: " + path.string() +
                 ": vehicle.battery_percent_per_km: is not given, and nothing else states what a kilometre takes of the battery; put it "
                 "there, or take a mission that has it: earshot init --battery-percent makes one, "
                 "firmware/boards/linux/missions/fenced_search.toml is one");
}

}  // namespace earshot::fly
