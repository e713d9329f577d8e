#pragma once

#include <filesystem>

#include "firmware/host/mission/mission_file.hpp"
#include "sim/search/scenario/scenario.hpp"
#include "sim/search/settings.hpp"

namespace earshot::fly {

/// What a flight is made of.
struct FlightPlan {
  host::MissionFile mission;
  search::Scenario scenario;
  search::SearchSettings search;  ///< the paper's search, with the mission's numbers in place of its own
};

/// Reads a mission and an ocean for it, and refuses two files that are right by themselves and do not fit each other.
/// @throws host::BadInput naming file and key.
[[nodiscard]] FlightPlan load_flight_plan(const std::filesystem::path& mission, const std::filesystem::path& environment);

}  // namespace earshot::fly
