#pragma once

#include <filesystem>
#include <optional>

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
/// @param vehicle  the configuration that judges the mission; nothing: anybody's is flown, and names the key of its policy itself
/// @throws host::BadInput naming file and key.
[[nodiscard]] FlightPlan load_flight_plan(const std::filesystem::path& mission, const std::filesystem::path& environment,
                                          const std::optional<std::filesystem::path>& vehicle = std::nullopt);

/// Of `--battery-percent` of both programs.
inline constexpr const char* kBatteryHelp =
    "simulate the battery, which has so much charge at the start: the vehicle reports it at every tick, and each kilometre takes the "
    "mission's "
    "vehicle.battery_percent_per_km, which it must have (earshot init --battery-percent, fenced_search.toml); default: the vehicle reports "
    "none";
/// @throws host::BadInput when the mission does not say what a kilometre takes of a battery that is to be simulated
void require_known_consumption(const config::Mission& mission, const std::filesystem::path& path);

}  // namespace earshot::fly
