#include "policy/description/search_description.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

#include "firmware/config/capacities.hpp"
#include "firmware/config_file/table_reader.hpp"

namespace earshot::description {
namespace {

using config_file::BadInput;
using Json = nlohmann::ordered_json;

constexpr std::string_view kFormat = "earshot search 1";

policy::ObservationElement element_from(const Json& json) {
  policy::ObservationElement element;
  const auto feature = json.at("feature").get<std::int64_t>();
  const auto age = json.at("age").get<std::int64_t>();
  const bool known = feature >= static_cast<int>(policy::Feature::kEast) && feature <= static_cast<int>(policy::Feature::kStepSnr);
  if (!known || age < 0 || age >= static_cast<int>(config::kMaxRememberedSteps)) throw BadInput("observation: unknown feature or age");
  element.feature = static_cast<policy::Feature>(feature);
  element.age = static_cast<std::uint8_t>(age);
  element.offset = json.at("offset").get<float>();
  element.scale = json.at("scale").get<float>();
  return element;
}

double length_from(const Json& json, const char* key) {
  const double length = json.at(key).get<double>();
  if (!(length > 0.0) || !std::isfinite(length)) throw BadInput(std::string(key) + ": must be above 0");
  return length;
}

void check_normalisation(const Json& json) {
  if (!json.contains("normalisation")) throw BadInput("normalisation: missing; nothing says that the network saw the observation as it is");
  if (json.at("normalisation") != "none")
    throw BadInput("normalisation: only a policy that saw the observation as it is (none) can be frozen");
}

SearchDescription description_of(const Json& json) {
  if (json.value("format", "") != kFormat) throw BadInput("not an " + std::string(kFormat));
  check_normalisation(json);
  SearchDescription description;
  for (const Json& element : json.at("observation")) {
    if (description.observation.push_back(element_from(element)) != Status::kOk) throw BadInput("observation: too many elements");
  }
  if (description.observation.empty()) throw BadInput("observation: has no elements");
  const auto directions = json.at("direction_count").get<std::int64_t>();
  if (directions < 1 || directions > static_cast<std::int64_t>(config::kMaxActions)) {
    throw BadInput("direction_count: must be 1 to " + std::to_string(config::kMaxActions));
  }
  description.direction_count = static_cast<std::size_t>(directions);
  description.step_length = Meters{length_from(json, "step_length_m")};
  description.area_size = {Meters{length_from(json, "area_north_m")}, Meters{length_from(json, "area_east_m")}};
  description.detection_threshold = Decibels{json.at("detection_threshold_db").get<double>()};
  for (const auto& [name, value] : json.at("provenance").items()) description.provenance.emplace_back(name, value.get<std::string>());
  return description;
}

}  // namespace

std::string to_text(const SearchDescription& description) {
  Json json;
  json["format"] = kFormat;
  json["normalisation"] = "none";
  json["observation"] = Json::array();
  for (const policy::ObservationElement& e : description.observation) {
    json["observation"].push_back({{"feature", static_cast<int>(e.feature)}, {"age", e.age}, {"offset", e.offset}, {"scale", e.scale}});
  }
  json["direction_count"] = description.direction_count;
  json["step_length_m"] = description.step_length.value;
  json["area_north_m"] = description.area_size.north.value;
  json["area_east_m"] = description.area_size.east.value;
  json["detection_threshold_db"] = description.detection_threshold.value;
  json["provenance"] = Json::object();
  for (const auto& [name, value] : description.provenance) json["provenance"][name] = value;
  return json.dump();
}

SearchDescription from_text(std::string_view text) {
  try {
    return description_of(Json::parse(text));
  } catch (const BadInput& e) {
    throw BadInput(std::string("search description: ") + e.what());
  } catch (const Json::parse_error&) {
    throw BadInput("search description: not JSON, or cut short");
  } catch (const Json::exception& e) {
    throw BadInput(std::string("search description: ") + e.what());
  }
}

}  // namespace earshot::description
