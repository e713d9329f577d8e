#pragma once

#include <nlohmann/json.hpp>
#include <span>

#include "firmware/config/mission.hpp"
#include "firmware/messages/health.hpp"
#include "policy/report/flight_files.hpp"

namespace earshot::report {

// The smaller parts of what a page is given of a flight, each as the page's type of that name; null: not known.

/// @param summary  of a simulator, which knows where the mission's plane lies; null: none
[[nodiscard]] nlohmann::ordered_json mission_value(const config::Mission& mission, const nlohmann::json& summary);
[[nodiscard]] nlohmann::ordered_json health_value(const messages::Health& health);
[[nodiscard]] nlohmann::ordered_json truth_value(const FlightFiles& files);
/// @param began_s  of the journal, on the clock of the sound
[[nodiscard]] nlohmann::ordered_json sound_value(const HeardSound& sound, double began_s);

}  // namespace earshot::report
