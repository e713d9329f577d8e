#include "policy/ppo/checkpoint/checkpoint.hpp"

#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>

#include "firmware/host/file/checksum_text.hpp"
#include "firmware/host/toml/table_reader.hpp"
#include "policy/description/json_fault.hpp"
#include "policy/description/search_json.hpp"
#include "policy/ppo/checkpoint/training_state_text.hpp"

namespace earshot::ppo {
namespace {

using host::BadInput;
using Json = nlohmann::ordered_json;

constexpr std::string_view kFormat = "earshot checkpoint 3";
constexpr std::string_view kCrcLine = "crc32 ";

Json to_json(const Continuation& c) {
  auto written = [](const Continuation::Written& w) { return Json{{"bytes", w.bytes}, {"crc32", w.crc32}}; };
  Json json{{"arguments", c.arguments},
            {"directory", c.directory},
            {"settings_crc32", c.settings_crc32},
            {"episodes", written(c.episodes)},
            {"updates", written(c.updates)}};
  if (c.curve) json["curve"] = *c.curve;
  json["state"] = to_json(c.state);
  return json;
}

Continuation continuation_from(const Json& json) {
  auto written = [](const Json& w) { return Continuation::Written{w.at("bytes").get<std::size_t>(), w.at("crc32").get<std::uint32_t>()}; };
  return {.state = training_state_from(json.at("state")),
          .arguments = json.at("arguments").get<std::vector<std::string>>(),
          .directory = json.at("directory").get<std::string>(),
          .settings_crc32 = json.at("settings_crc32").get<std::uint32_t>(),
          .episodes = written(json.at("episodes")),
          .updates = written(json.at("updates")),
          .curve = json.contains("curve") ? std::optional(json.at("curve").get<std::string>()) : std::nullopt};
}

std::string crc_line(std::string_view json) {
  return std::string(kCrcLine) + host::crc32_text(host::crc32_of(json)) + "\n";
}

/// The first line, when the second holds its CRC-32.
std::string_view checked(std::string_view text) {
  constexpr std::string_view kBegin = R"({"format":"earshot checkpoint )";
  const std::string_view json = text.substr(0, std::min(text.size(), text.find('\n')));
  const bool has_format = json.starts_with(kBegin) && json.find('"', kBegin.size()) != std::string_view::npos;
  const bool another = has_format && json.substr(0, json.find('"', kBegin.size())) != R"({"format":")" + std::string(kFormat);
  if (another) throw BadInput("of another version than this program's, which is " + std::string(kFormat));
  if (text.size() == json.size() || text.substr(json.size() + 1) != crc_line(json))
    throw BadInput("not a checkpoint, cut short or damaged");
  return json;
}

Checkpoint checkpoint_from(const Json& json) {
  if (json.value("format", "") != kFormat) throw BadInput("not an " + std::string(kFormat));
  Checkpoint checkpoint{description::read(json), {}};
  checkpoint.parameters = json.at("parameters").get<std::vector<float>>();

  if (json.contains("continuation")) checkpoint.continuation = continuation_from(json.at("continuation"));

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
  description::write(checkpoint, json);
  json["parameters"] = checkpoint.parameters;
  if (checkpoint.continuation) json["continuation"] = to_json(*checkpoint.continuation);
  const std::string text = json.dump();
  return text + "\n" + crc_line(text);
}

Checkpoint from_text(std::string_view text, const std::string& file) {
  try {
    return checkpoint_from(Json::parse(checked(text)));
  } catch (const nlohmann::json::exception& e) {
    throw BadInput(file + ": not a whole checkpoint: " + description::to_string(e));
  } catch (const BadInput& e) {
    throw BadInput(file + ": " + e.what());
  }
}

}  // namespace earshot::ppo
