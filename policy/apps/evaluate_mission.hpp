#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "firmware/host/mission/mission_file.hpp"
#include "policy/command_line/scenario_options.hpp"
#include "policy/evaluate/candidates.hpp"
#include "policy/evaluate/world_file.hpp"
#include "sim/search/settings.hpp"

namespace earshot::evaluate {

/// The mission whose search is flown: area, depth, speed, steps and limits are its own.
struct FlownMission {
  std::filesystem::path path;
  host::MissionFile file;
};

/// @throws BadInput for what is no mission, or is wrong with one
[[nodiscard]] FlownMission read_mission(const std::filesystem::path& path);

/// The policy that the mission names, called as its file is.
[[nodiscard]] Candidate policy_of(const FlownMission& mission);

/// Depth and steps where no option says them: as many steps as max_steps and max_time_s leave.
[[nodiscard]] command_line::ScenarioOptions with_mission(command_line::ScenarioOptions given, const FlownMission& mission);

/// The area, the step, the threshold and what is heard of a leg.
/// @param candidates  that are learned must be of the same
/// @throws BadInput where they are not
void apply(const FlownMission& mission, std::span<const Candidate> candidates, search::SearchSettings& settings);

/// The vehicle is as deep and as fast in every world as in the mission.
/// @param is_depth_given  by an option, which then holds
/// @throws BadInput where a world's source is of another frequency than the mission listens for: it would not be heard at sea
void apply(const FlownMission& mission, bool is_depth_given, std::vector<WorldFile>& worlds);

/// What a mission is flown in where nobody says it is the ocean that ships, which its own water may not resemble. "" of a mission that
/// ships, which is for that ocean.
/// @param file  of the environment
[[nodiscard]] std::string warning_about_ocean(const FlownMission& mission, const ocean::Environment& environment,
                                              const std::filesystem::path& file);

/// "mission search.toml: 300 m deep, 2 m/s, at most 100 steps of 1000 m \n"
[[nodiscard]] std::string to_string(const FlownMission& mission);

}  // namespace earshot::evaluate
