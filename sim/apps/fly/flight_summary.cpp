#include "sim/apps/fly/flight_summary.hpp"

#include <algorithm>

#include "firmware/core/time.hpp"
#include "firmware/host/program/wrapped.hpp"
#include "firmware/host/text/duration.hpp"
#include "firmware/host/text/numbers.hpp"
#include "sim/apps/fly/search_account.hpp"
#include "sim/search/account/numbers.hpp"
#include "sim/search/account/search_account.hpp"

namespace earshot::fly {
namespace {

using host::decimals;
using nlohmann::json;

std::string km(double length_m) {
  return decimals(length_m / 1e3, 1) + " km";
}

std::string simulation_line(const json& s) {
  const std::string date = s.contains("flown_utc") ? " on " + s.at("flown_utc").get<std::string>() + " UTC" : "";
  return entry("simulation", "flown" + date + ": ocean, noise and source are computed, and no vehicle was at sea");
}

std::string place_line(const json& s) {
  if (!s.contains("area")) return "";
  const json& low = s.at("area").at("south_west");
  const json& high = s.at("area").at("north_east");
  const auto side = [&](const char* axis) { return high.at(axis).get<double>() - low.at(axis).get<double>(); };
  const std::string place = search::place_of_area(s, "");
  return entry("area", km(side("north_m")) + " north by " + km(side("east_m")) + " east" + (place.empty() ? "" : "; " + place));
}

std::string vehicle_line(const json& s) {
  if (!s.contains("speed_mps")) return "";
  return entry("vehicle",
               decimals(s.at("depth_m"), 0) + " m deep, " + decimals(s.at("speed_mps"), 1) + " m/s, steps of " + km(s.at("step_length_m")));
}

std::string source_line(const json& s) {
  if (!s.contains("source_frequency_hz")) return "";
  const bool is_fixed = s.value("source_is_fixed", false);
  return entry("source", decimals(s.at("source_frequency_hz"), 1) + " Hz" +
                             (is_fixed ? ", where the environment has it" : "; the vehicle does not know where it is"));
}

std::string steps_to_string(const json& s) {
  return std::to_string(s.at("steps").get<int>()) + (s.contains("max_steps") ? " of " + std::to_string(s.at("max_steps").get<int>()) : "");
}

std::string time_to_string(const json& s) {
  const double sim_time_s = s.at("sim_time_s");
  const double wall_time_s = s.at("wall_time_s");
  return host::duration(sim_time_s) + " at sea, simulated in " + decimals(wall_time_s, 2) +
         " s: " + decimals(sim_time_s / std::max(wall_time_s, 1e-9), 0) + " times real time";
}

}  // namespace

std::string to_string_of_summary(const json& s) {
  std::string text = program::wrapped(search::verdict_on(search::account_in(s)).text, 0, 2) + "\n" + simulation_line(s) + place_line(s) +
                     vehicle_line(s) + source_line(s);
  text += entry("reward", decimals(s.at("reward"), 1) + ": " + search::kRewardMeans);
  text += entry("steps", steps_to_string(s));
  text += entry("detections",
                std::to_string(s.at("detections").get<int>()) + ": each is " + search::detection_means(s.at("detection_threshold_db")));
  text += entry("distance", km(s.at("distance_m")));
  text += entry("time", time_to_string(s));
  return text + account_lines(s);
}

}  // namespace earshot::fly
