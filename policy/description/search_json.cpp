#include "policy/description/search_json.hpp"

#include <cmath>
#include <cstdint>

#include "firmware/config/capacities.hpp"
#include "firmware/host/listening/listening_words.hpp"
#include "firmware/host/toml/table_reader.hpp"
#include "sim/search/actions/compass_directions.hpp"
#include "sim/search/settings.hpp"

namespace earshot::description {
namespace {

using host::BadInput;
using Json = nlohmann::ordered_json;

/// A whole number in a range; get<>() alone wraps and truncates without a word.
std::int64_t integer_from(const Json& json, const char* key, std::int64_t lowest, std::int64_t highest) {
  const Json& value = json.at(key);
  const bool fits_64_bits = value.is_number_integer() && (!value.is_number_unsigned() || value.get<std::uint64_t>() <= INT64_MAX);
  const std::int64_t number = fits_64_bits ? value.get<std::int64_t>() : -1;
  if (fits_64_bits && number >= lowest && number <= highest) return number;
  throw BadInput(std::string(key) + ": must be a whole number, " + std::to_string(lowest) + " to " + std::to_string(highest));
}

std::uint16_t cells_from(const Json& json, const char* key) {
  return static_cast<std::uint16_t>(integer_from(json, key, 1, config::kMaxBeliefCells));
}

policy::ObservationElement element_from(const Json& json) {
  policy::ObservationElement element;
  element.feature = static_cast<policy::Feature>(integer_from(json, "feature", 0, 255));
  if (!policy::is_known(element.feature)) throw BadInput("observation: unknown feature");
  element.age = static_cast<std::uint8_t>(integer_from(json, "age", 0, 255));
  element.offset = json.at("offset").get<float>();
  element.scale = json.at("scale").get<float>();
  return element;
}

config::ListeningWindow listening_from(const Json& json) {
  try {
    return host::listening_window(json.at("listening").get<std::string>(),
                                  integer_from(json, "listening_window_s", 0, config::kMaxListeningSeconds));
  } catch (const BadInput& e) {
    throw BadInput(std::string("listening: ") + e.what());
  }
}

policy::BeliefCosts costs_from(const Json& json) {
  return {.step = json.at("step").get<float>(),
          .log_step_discount = json.at("log_step_discount").get<float>(),
          .find_probability = json.at("reach").get<float>(),
          .find_discount = json.at("reach_discount").get<float>(),
          .edge = json.at("edge").get<float>(),
          .most_regret = json.at("most_regret").get<float>()};
}

Json costs_to(const policy::BeliefCosts& costs) {
  return {{"step", costs.step},
          {"log_step_discount", costs.log_step_discount},
          {"reach", costs.find_probability},
          {"reach_discount", costs.find_discount},
          {"edge", costs.edge},
          {"most_regret", costs.most_regret}};
}

/// The numbers of a belief that the description does not hold elsewhere.
policy::BeliefModel belief_from(const Json& json) {
  if (json.contains("snr_db"))
    throw BadInput(
        "belief: is one in a single ocean, which no program flies any more: what is possible of the ocean is in ocean tables; train it "
        "again");
  policy::BeliefModel model;
  model.cells_north = cells_from(json, "cells_north");
  model.cells_east = cells_from(json, "cells_east");
  model.border_width = Meters{json.at("border_width_m").get<double>()};
  model.costs = costs_from(json.at("costs"));
  model.outlier_share = json.at("outlier_share").get<float>();
  return model;
}

Json belief_to(const policy::BeliefModel& model) {
  Json json;
  json["cells_north"] = model.cells_north;
  json["cells_east"] = model.cells_east;
  json["border_width_m"] = model.border_width.value;
  json["costs"] = costs_to(model.costs);
  json["outlier_share"] = model.outlier_share;
  return json;
}

/// Gives the belief the description's own numbers, and refuses one that cannot be.
void complete_belief(SearchDescription& description) {
  policy::BeliefModel& belief = description.observation.belief;
  belief.area_size = description.area_size;
  belief.step_length = description.step_length;
  belief.detection_threshold = description.detection_threshold;
  belief.actions = search::compass_directions(description.direction_count);
  if (!policy::needs_belief(description.observation.spec)) return;
  if (!policy::has_valid_shape(belief) || !policy::has_valid_numbers(belief)) throw BadInput("belief: a number is out of its range");
}

double length_from(const Json& json, const char* key) {
  const double length = json.at(key).get<double>();
  if (!(length > 0.0) || !std::isfinite(length)) throw BadInput(std::string(key) + ": must be above 0");
  return length;
}

}  // namespace

void write(const SearchDescription& description, Json& json) {
  json["observation"] = Json::array();
  for (const policy::ObservationElement& e : description.observation.spec) {
    json["observation"].push_back({{"feature", static_cast<int>(e.feature)}, {"age", e.age}, {"offset", e.offset}, {"scale", e.scale}});
  }
  if (policy::needs_belief(description.observation.spec)) json["belief"] = belief_to(description.observation.belief);
  json["direction_count"] = description.direction_count;
  json["step_length_m"] = description.step_length.value;
  json["area_north_m"] = description.area_size.north.value;
  json["area_east_m"] = description.area_size.east.value;
  json["detection_threshold_db"] = description.detection_threshold.value;
  if (description.observation.listening != config::ListeningWindow{}) {
    json["listening"] = host::word_for(description.observation.listening.listening);
    json["listening_window_s"] = host::length_s(description.observation.listening);
  }
  json["provenance"] = Json::object();
  for (const auto& [name, value] : description.provenance) json["provenance"][name] = value;
}

SearchDescription read(const Json& json) {
  SearchDescription description;
  for (const Json& element : json.at("observation")) {
    if (description.observation.spec.push_back(element_from(element)) != Status::kOk) throw BadInput("observation: too many elements");
  }
  if (json.contains("belief")) description.observation.belief = belief_from(json.at("belief"));
  if (description.observation.spec.empty()) throw BadInput("observation: has no elements");
  description.direction_count = static_cast<std::size_t>(integer_from(json, "direction_count", 1, config::kMaxActions));
  description.step_length = Meters{length_from(json, "step_length_m")};
  description.area_size = {Meters{length_from(json, "area_north_m")}, Meters{length_from(json, "area_east_m")}};
  description.detection_threshold = Decibels{json.at("detection_threshold_db").get<double>()};
  if (json.contains("listening")) description.observation.listening = listening_from(json);
  for (const auto& [name, value] : json.at("provenance").items()) description.provenance.emplace_back(name, value.get<std::string>());
  complete_belief(description);
  return description;
}

}  // namespace earshot::description
