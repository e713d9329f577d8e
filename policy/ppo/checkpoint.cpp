#include "policy/ppo/checkpoint.hpp"

#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>

#include "firmware/config/capacities.hpp"
#include "firmware/config_file/table_reader.hpp"

namespace earshot::ppo {
namespace {

using config_file::BadInput;
using Json = nlohmann::ordered_json;

constexpr std::string_view kFormat = "earshot checkpoint 2";

policy::ObservationElement element_from(const Json& json) {
  policy::ObservationElement element;
  const int feature = json.at("feature").get<int>();
  const int age = json.at("age").get<int>();
  const bool known = feature >= static_cast<int>(policy::Feature::kEast) && feature <= static_cast<int>(policy::Feature::kStepSnr);
  if (!known || age < 0 || age >= static_cast<int>(config::kMaxRememberedSteps)) throw BadInput("observation: unknown feature or age");
  element.feature = static_cast<policy::Feature>(feature);
  element.age = static_cast<std::uint8_t>(age);
  element.offset = json.at("offset").get<float>();
  element.scale = json.at("scale").get<float>();
  return element;
}

Checkpoint checkpoint_from(const Json& json) {
  if (json.value("format", "") != kFormat) throw BadInput("not an " + std::string(kFormat));
  Checkpoint checkpoint;
  for (const Json& element : json.at("observation")) {
    if (checkpoint.observation.push_back(element_from(element)) != Status::kOk) throw BadInput("observation: too many elements");
  }
  checkpoint.direction_count = json.at("direction_count").get<std::size_t>();
  checkpoint.step_length = Meters{json.at("step_length_m").get<double>()};
  checkpoint.area_size = {Meters{json.at("area_north_m").get<double>()}, Meters{json.at("area_east_m").get<double>()}};
  checkpoint.detection_threshold = Decibels{json.at("detection_threshold_db").get<double>()};
  for (const auto& [name, value] : json.at("provenance").items()) checkpoint.provenance.emplace_back(name, value.get<std::string>());
  checkpoint.parameters = json.at("parameters").get<std::vector<float>>();

  const bool sizes =
      !checkpoint.observation.empty() && checkpoint.direction_count >= 1 && checkpoint.direction_count <= config::kMaxActions;
  const bool lengths =
      checkpoint.step_length.value > 0.0 && checkpoint.area_size.north.value > 0.0 && checkpoint.area_size.east.value > 0.0;
  if (!sizes || !lengths) throw BadInput("observation, direction_count, step_length_m, area_north_m or area_east_m is out of range");
  const std::size_t expected = ActorCritic<float>(checkpoint.shape()).parameters().size();
  if (checkpoint.parameters.size() != expected) {
    throw BadInput("parameters: " + std::to_string(checkpoint.parameters.size()) + " numbers, its shape needs " + std::to_string(expected));
  }
  for (const float p : checkpoint.parameters) {
    if (!std::isfinite(p)) throw BadInput("parameters: a number is not finite");
  }
  return checkpoint;
}

}  // namespace

std::string to_text(const Checkpoint& checkpoint) {
  Json json;
  json["format"] = kFormat;
  json["observation"] = Json::array();
  for (const policy::ObservationElement& e : checkpoint.observation) {
    json["observation"].push_back({{"feature", static_cast<int>(e.feature)}, {"age", e.age}, {"offset", e.offset}, {"scale", e.scale}});
  }
  json["direction_count"] = checkpoint.direction_count;
  json["step_length_m"] = checkpoint.step_length.value;
  json["area_north_m"] = checkpoint.area_size.north.value;
  json["area_east_m"] = checkpoint.area_size.east.value;
  json["detection_threshold_db"] = checkpoint.detection_threshold.value;
  json["provenance"] = Json::object();
  for (const auto& [name, value] : checkpoint.provenance) json["provenance"][name] = value;
  json["parameters"] = checkpoint.parameters;
  return json.dump() + "\n";
}

Checkpoint from_text(std::string_view text, const std::string& file) {
  try {
    return checkpoint_from(Json::parse(text));
  } catch (const nlohmann::json::parse_error&) {
    throw BadInput(file + ": not a checkpoint, or cut short");
  } catch (const nlohmann::json::exception& e) {
    throw BadInput(file + ": not a whole checkpoint: " + e.what());
  } catch (const BadInput& e) {
    throw BadInput(file + ": " + e.what());
  }
}

}  // namespace earshot::ppo
