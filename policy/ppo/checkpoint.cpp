#include "policy/ppo/checkpoint.hpp"

#include <cmath>
#include <cstdint>
#include <iomanip>
#include <nlohmann/json.hpp>
#include <sstream>

#include "firmware/config/capacities.hpp"
#include "firmware/config_file/table_reader.hpp"
#include "firmware/core/crc32.hpp"
#include "policy/ppo/training_state_text.hpp"
#include "sim/search/settings.hpp"

namespace earshot::ppo {
namespace {

using config_file::BadInput;
using Json = nlohmann::ordered_json;

constexpr std::string_view kFormat = "earshot checkpoint 3";
constexpr std::string_view kCrcLine = "crc32 ";
constexpr std::size_t kCrcDigits = 8;

policy::ObservationElement element_from(const Json& json) {
  policy::ObservationElement element;
  const int feature = json.at("feature").get<int>();
  const int age = json.at("age").get<int>();
  const bool known = feature >= 0 && feature <= 255 && policy::is_known(static_cast<policy::Feature>(feature));
  if (!known || age < 0 || age > 255) throw BadInput("observation: unknown feature or age");
  element.feature = static_cast<policy::Feature>(feature);
  element.age = static_cast<std::uint8_t>(age);
  element.offset = json.at("offset").get<float>();
  element.scale = json.at("scale").get<float>();
  return element;
}

Json to_json(const Continuation& c) {
  auto written = [](const Continuation::Written& w) { return Json{{"bytes", w.bytes}, {"crc32", w.crc32}}; };
  return {{"arguments", c.arguments},        {"directory", c.directory},      {"settings_crc32", c.settings_crc32},
          {"episodes", written(c.episodes)}, {"updates", written(c.updates)}, {"state", to_json(c.state)}};
}

Continuation continuation_from(const Json& json) {
  auto written = [](const Json& w) { return Continuation::Written{w.at("bytes").get<std::size_t>(), w.at("crc32").get<std::uint32_t>()}; };
  return {.state = training_state_from(json.at("state")),
          .arguments = json.at("arguments").get<std::vector<std::string>>(),
          .directory = json.at("directory").get<std::string>(),
          .settings_crc32 = json.at("settings_crc32").get<std::uint32_t>(),
          .episodes = written(json.at("episodes")),
          .updates = written(json.at("updates"))};
}

std::string crc_line(std::string_view json) {
  std::ostringstream line;
  line << kCrcLine << std::hex << std::setw(kCrcDigits) << std::setfill('0')
       << crc32({reinterpret_cast<const std::uint8_t*>(json.data()), json.size()}) << '\n';
  return line.str();
}

/// The first line, when the second holds its CRC-32.
std::string_view checked(std::string_view text) {
  constexpr std::string_view kBegin = R"({"format":"earshot checkpoint )";
  const std::string_view json = text.substr(0, std::min(text.size(), text.find('\n')));
  const bool said = json.starts_with(kBegin) && json.find('"', kBegin.size()) != std::string_view::npos;
  const bool another = said && json.substr(0, json.find('"', kBegin.size())) != R"({"format":")" + std::string(kFormat);
  if (another) throw BadInput("of another version than this program's, which is " + std::string(kFormat));
  if (text.size() == json.size() || text.substr(json.size() + 1) != crc_line(json))
    throw BadInput("not a checkpoint, cut short or damaged");
  return json;
}

template <class Vector, class Value>
void append(Vector& vector, const Value& value) {
  if (vector.push_back(value) != Status::kOk) throw BadInput("belief: too many hypotheses or ranges");
}

/// What is not in the checkpoint's own numbers.
policy::BeliefModel belief_from(const Json& json) {
  policy::BeliefModel model;
  model.cells_north = json.at("cells_north").get<std::uint16_t>();
  model.cells_east = json.at("cells_east").get<std::uint16_t>();
  model.border_width = Meters{json.at("border_width_m").get<double>()};
  model.outlier_share = json.at("outlier_share").get<float>();
  model.silence_share = json.at("silence_share").get<float>();
  model.forgotten_share = json.at("forgotten_share").get<float>();
  for (const Json& h : json.at("hypotheses")) {
    append(model.hypotheses, policy::BeliefHypothesis{.level_offset_db = h.at("level_offset_db").get<float>(),
                                                      .spread_db = h.at("spread_db").get<float>(),
                                                      .prior = h.at("prior").get<float>()});
  }
  model.range_step = Meters{json.at("range_step_m").get<double>()};
  for (const Json& snr : json.at("snr_db")) append(model.snr_db, snr.get<float>());
  return model;
}

Json belief_to(const policy::BeliefModel& model) {
  Json json;
  json["cells_north"] = model.cells_north;
  json["cells_east"] = model.cells_east;
  json["border_width_m"] = model.border_width.value;
  json["outlier_share"] = model.outlier_share;
  json["silence_share"] = model.silence_share;
  json["forgotten_share"] = model.forgotten_share;
  json["hypotheses"] = Json::array();
  for (const policy::BeliefHypothesis& h : model.hypotheses) {
    json["hypotheses"].push_back({{"level_offset_db", h.level_offset_db}, {"spread_db", h.spread_db}, {"prior", h.prior}});
  }
  json["range_step_m"] = model.range_step.value;
  json["snr_db"] = model.snr_db.span();
  return json;
}

/// Gives the belief the checkpoint's own numbers, and refuses one that cannot be.
void complete_belief(Checkpoint& checkpoint) {
  policy::BeliefModel& belief = checkpoint.observation.belief;
  belief.area_size = checkpoint.area_size;
  belief.step_length = checkpoint.step_length;
  belief.detection_threshold = checkpoint.detection_threshold;
  belief.actions = search::compass_directions(checkpoint.direction_count);
  if (!policy::needs_belief(checkpoint.observation.spec)) return;
  if (!policy::has_valid_shape(belief) || !policy::has_valid_numbers(belief)) throw BadInput("belief: a number is out of its range");
}

Checkpoint checkpoint_from(const Json& json) {
  if (json.value("format", "") != kFormat) throw BadInput("not an " + std::string(kFormat));
  Checkpoint checkpoint;
  for (const Json& element : json.at("observation")) {
    if (checkpoint.observation.spec.push_back(element_from(element)) != Status::kOk) throw BadInput("observation: too many elements");
  }
  if (json.contains("belief")) checkpoint.observation.belief = belief_from(json.at("belief"));
  checkpoint.direction_count = json.at("direction_count").get<std::size_t>();
  checkpoint.step_length = Meters{json.at("step_length_m").get<double>()};
  checkpoint.area_size = {Meters{json.at("area_north_m").get<double>()}, Meters{json.at("area_east_m").get<double>()}};
  checkpoint.detection_threshold = Decibels{json.at("detection_threshold_db").get<double>()};
  for (const auto& [name, value] : json.at("provenance").items()) checkpoint.provenance.emplace_back(name, value.get<std::string>());
  checkpoint.parameters = json.at("parameters").get<std::vector<float>>();

  if (json.contains("continuation")) checkpoint.continuation = continuation_from(json.at("continuation"));

  const bool sizes =
      !checkpoint.observation.spec.empty() && checkpoint.direction_count >= 1 && checkpoint.direction_count <= config::kMaxActions;
  const bool lengths =
      checkpoint.step_length.value > 0.0 && checkpoint.area_size.north.value > 0.0 && checkpoint.area_size.east.value > 0.0;
  if (!sizes || !lengths) throw BadInput("observation, direction_count, step_length_m, area_north_m or area_east_m is out of range");
  complete_belief(checkpoint);
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
  for (const policy::ObservationElement& e : checkpoint.observation.spec) {
    json["observation"].push_back({{"feature", static_cast<int>(e.feature)}, {"age", e.age}, {"offset", e.offset}, {"scale", e.scale}});
  }
  if (policy::needs_belief(checkpoint.observation.spec)) json["belief"] = belief_to(checkpoint.observation.belief);
  json["direction_count"] = checkpoint.direction_count;
  json["step_length_m"] = checkpoint.step_length.value;
  json["area_north_m"] = checkpoint.area_size.north.value;
  json["area_east_m"] = checkpoint.area_size.east.value;
  json["detection_threshold_db"] = checkpoint.detection_threshold.value;
  json["provenance"] = Json::object();
  for (const auto& [name, value] : checkpoint.provenance) json["provenance"][name] = value;
  json["parameters"] = checkpoint.parameters;
  if (checkpoint.continuation) json["continuation"] = to_json(*checkpoint.continuation);
  const std::string text = json.dump();
  return text + "\n" + crc_line(text);
}

Checkpoint from_text(std::string_view text, const std::string& file) {
  try {
    return checkpoint_from(Json::parse(checked(text)));
  } catch (const nlohmann::json::exception& e) {
    throw BadInput(file + ": not a whole checkpoint: " + e.what());
  } catch (const BadInput& e) {
    throw BadInput(file + ": " + e.what());
  }
}

}  // namespace earshot::ppo
