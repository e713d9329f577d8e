#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "firmware/core/geometry.hpp"
#include "firmware/core/units.hpp"
#include "policy/report/sea/sea_flight.hpp"

namespace earshot::report {

/// What was searched for, where, how and when. A summary of an earlier version knows less.
struct Conditions {
  bool is_simulated = true;  ///< false: by its clock the vehicle was at sea
  std::optional<Hertz> frequency = std::nullopt;
  std::optional<Meters> depth = std::nullopt;
  std::optional<MetersPerSecond> speed = std::nullopt;
  NorthEast area_size;
  std::string place;  ///< of the area on the globe; "": unknown
  std::string date;   ///< UTC; "": unknown
};

[[nodiscard]] Conditions conditions_in(const nlohmann::json& summary);
[[nodiscard]] Conditions conditions_of(const SeaFlight& flight);

/// What a page of a simulated flight says first.
inline constexpr const char* kSimulationNote =
    "This flight is a simulation. Ocean, noise and source are computed, and no vehicle was at sea. What decided is the software that flies "
    "on the vehicle.";

/// One of them: its name, its value with the unit, and what it means ("": the name says it).
struct Condition {
  std::string name;
  std::string value;
  std::string meaning = "";
};
/// What is unknown is left out.
[[nodiscard]] std::vector<Condition> listed(const Conditions& conditions);

/// "Frequency of the source 20.0 Hz; depth of the vehicle 300 m; area 25.0 x 25.0 km"
[[nodiscard]] std::string to_string(const Conditions& conditions);

}  // namespace earshot::report
