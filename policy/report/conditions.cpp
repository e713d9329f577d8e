#include "policy/report/conditions.hpp"

#include "firmware/host/journal/words/wording.hpp"
#include "policy/explain/wording.hpp"
#include "policy/report/flight_files.hpp"
#include "sim/search/account/search_account.hpp"

namespace earshot::report {
namespace {

using explain::fixed;

std::string size_to_string(NorthEast size) {
  return fixed(size.north.value / 1e3, 1) + " \u00D7 " + fixed(size.east.value / 1e3, 1) + " km";
}

}  // namespace

Conditions conditions_in(const nlohmann::json& s) {
  Conditions conditions{.area_size = place_in(s.at("area").at("north_east")) - place_in(s.at("area").at("south_west")),
                        .place = search::place_of_area(s, "\u00B0"),
                        .date = s.contains("flown_utc") ? s.at("flown_utc").get<std::string>() + " UTC" : ""};
  if (s.contains("source_frequency_hz")) conditions.frequency = Hertz{s.at("source_frequency_hz").get<double>()};
  if (s.contains("depth_m")) conditions.depth = Meters{s.at("depth_m").get<double>()};
  if (s.contains("speed_mps")) conditions.speed = MetersPerSecond{s.at("speed_mps").get<double>()};
  return conditions;
}

Conditions conditions_of(const SeaFlight& flight) {
  return {.is_simulated = !flight.is_dated(),
          .frequency = flight.frequency,
          .depth = flight.depth,
          .speed = flight.speed,
          .area_size = flight.area.north_east - flight.area.south_west,
          .place = "",
          .date = flight.is_dated() ? journal::utc(flight.began) : ""};
}

std::vector<Condition> listed(const Conditions& c) {
  std::vector<Condition> all;
  if (c.frequency) all.push_back({"frequency of the source", fixed(c.frequency->value, 1) + " Hz"});
  if (c.depth) all.push_back({"depth of the vehicle", fixed(c.depth->value, 0) + " m"});
  if (c.speed) all.push_back({"speed of the vehicle", fixed(c.speed->value, 1) + " m/s"});
  all.push_back({"area", size_to_string(c.area_size), c.place});
  if (!c.date.empty()) all.push_back({c.is_simulated ? "simulated on" : "flown on", c.date});
  return all;
}

std::string to_string(const Conditions& conditions) {
  std::string text;
  for (const Condition& one : listed(conditions))
    text += (text.empty() ? "" : "; ") + one.name + " " + one.value + (one.meaning.empty() ? "" : " (" + one.meaning + ")");
  text.front() = static_cast<char>(text.front() - 'a' + 'A');
  return text;
}

}  // namespace earshot::report
