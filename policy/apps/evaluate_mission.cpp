#include "policy/apps/evaluate_mission.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <system_error>

#include "firmware/host/file/bad_input.hpp"
#include "firmware/host/file/input_file.hpp"
#include "firmware/host/file/printable.hpp"
#include "firmware/host/file/shipped.hpp"
#include "firmware/host/policy/unverified_policy.hpp"
#include "firmware/policy/tables/ocean_tables.hpp"
#include "sim/search/scenario/file_kind.hpp"

namespace earshot::evaluate {
namespace {

using host::BadInput;

/// Those that are begun and ended within the mission's time.
std::uint32_t steps_in_time(const config::Mission& mission) {
  const double step_s = mission.step_length.value / mission.search_speed.value;
  const double steps = std::floor(mission.max_time.to_seconds() / step_s);
  return static_cast<std::uint32_t>(std::clamp(steps, 1.0, static_cast<double>(mission.max_steps)));
}

std::string complaint(const FlownMission& mission, const std::string& key, double in_mission, const std::string& name, double trained,
                      const char* unit) {
  std::ostringstream text;
  text << "--mission " << mission.path.string() << ": " << key << " = " << in_mission << unit << ", but " << name << " is for " << trained
       << unit;
  return text.str();
}

void require_alike(const FlownMission& mission, const std::string& key, double in_mission, const Candidate& c, double trained,
                   const char* unit) {
  if (std::abs(in_mission - trained) > 1e-6 * std::abs(trained)) throw BadInput(complaint(mission, key, in_mission, c.name, trained, unit));
}

}  // namespace

FlownMission read_mission(const std::filesystem::path& path) {
  const std::string text = host::read_text(path, host::kTomlFile);
  const host::TomlFile file(path, text);
  search::require_kind("--mission", file, search::FileKind::kMission);
  return {.path = path, .file = host::load_mission(file, text)};
}

Candidate policy_of(const FlownMission& mission) {
  const std::filesystem::path& file = mission.file.policy;
  return {.name = file.filename().string(), .learned = host::load_unverified_policy(file), .file = file};
}

command_line::ScenarioOptions with_mission(command_line::ScenarioOptions given, const FlownMission& mission) {
  if (!given.vehicle_depth_m) given.vehicle_depth_m = mission.file.mission.search_depth.value;
  if (!given.max_steps) given.max_steps = steps_in_time(mission.file.mission);
  return given;
}

void apply(const FlownMission& mission, std::span<const Candidate> candidates, search::SearchSettings& settings) {
  const config::Mission& m = mission.file.mission;
  const NorthEast size = m.operating_area.north_east - m.operating_area.south_west;
  for (const Candidate& c : candidates) {
    if (!c.learned) continue;
    require_alike(mission, "area, south to north", size.north.value, c, c.learned->area_size.north.value, " m");
    require_alike(mission, "area, west to east", size.east.value, c, c.learned->area_size.east.value, " m");
    require_alike(mission, "search.step_length_m", m.step_length.value, c, c.learned->step_length.value, " m");
    require_alike(mission, "search.detection_threshold_db", m.detection_threshold.value, c, c.learned->detection_threshold.value, " dB");
  }
  settings.domain = m.operating_area;
  settings.start_region = settings.domain;
  settings.step_length = m.step_length;
  settings.detection_threshold = m.detection_threshold;
  settings.listening = m.listening;
}

void apply(const FlownMission& mission, bool is_depth_given, std::vector<WorldFile>& worlds) {
  const config::Mission& m = mission.file.mission;
  for (WorldFile& world : worlds) {
    const double heard_hz = world.scenario.environment.source.frequency.value;
    if (std::abs(heard_hz - m.source_frequency.value) > policy::kFrequencyTolerance * m.source_frequency.value) {
      std::ostringstream text;
      text << "--mission " << mission.path.string() << ": searches for a sound of " << m.source_frequency.value << " Hz, but the source of "
           << world.name << " is of " << heard_hz << " Hz";
      throw BadInput(text.str());
    }
    if (!is_depth_given) world.vehicle_depth = m.search_depth;
    if (!(*world.vehicle_depth < world.scenario.environment.seabed.depth)) {
      std::ostringstream text;
      text << "--mission " << mission.path.string() << ": search.depth_m = " << world.vehicle_depth->value
           << ": must be less than the depth of the sea floor in " << world.name << ", " << world.scenario.environment.seabed.depth.value
           << " m";
      throw BadInput(text.str());
    }
    world.scenario.conditions.vehicle_speed = m.search_speed;
  }
}

std::string to_string(const FlownMission& mission) {
  const config::Mission& m = mission.file.mission;
  std::ostringstream text;
  text << "mission " << host::printable(mission.path.string()) << ": " << m.search_depth.value << " m deep, " << m.search_speed.value
       << " m/s, at most " << steps_in_time(m) << " steps of " << m.step_length.value << " m";
  if (steps_in_time(m) < m.max_steps) text << " (of " << m.max_steps << ", for more do not fit into max_time_s)";
  text << "\n";
  return text.str();
}

std::string warning_about_ocean(const FlownMission& mission, const ocean::Environment& environment, const std::filesystem::path& file) {
  std::error_code differ;
  const std::filesystem::path folder = std::filesystem::absolute(mission.path).parent_path();
  if (std::filesystem::equivalent(folder, host::shipped("firmware/boards/linux/missions"), differ)) return "";
  const std::filesystem::path own = mission.path.parent_path() / "ocean.toml";
  std::ostringstream text;
  text << "no --environment is given: " << mission.path.string() << " is flown in the ocean of " << file.filename().string()
       << ", whose sea floor lies at " << environment.seabed.depth.value << " m";
  if (std::filesystem::exists(own)) text << "; " << own.string() << " lies beside the mission";
  return text.str();
}

}  // namespace earshot::evaluate
