#include "policy/description/search_description.hpp"

#include "firmware/host/toml/table_reader.hpp"
#include "policy/description/json_fault.hpp"
#include "policy/description/search_json.hpp"

namespace earshot::description {
namespace {

using host::BadInput;
using Json = nlohmann::ordered_json;

constexpr std::string_view kFormat = "earshot search 1";

void check_normalisation(const Json& json) {
  if (!json.contains("normalisation"))
    throw BadInput("normalisation: missing; nothing states that the network saw the observation as it is");
  if (json.at("normalisation") != "none")
    throw BadInput("normalisation: only a policy that saw the observation as it is (none) can be frozen");
}

SearchDescription checked(const Json& json) {
  if (json.value("format", "") != kFormat) throw BadInput("not an " + std::string(kFormat));
  check_normalisation(json);
  return read(json);
}

}  // namespace

SearchDescription describe(const search::SearchSettings& settings, const policy::ObservationModel& observation) {
  return {.observation = observation,
          .direction_count = settings.direction_count,
          .step_length = settings.step_length,
          .area_size = settings.domain.north_east - settings.domain.south_west,
          .detection_threshold = settings.detection_threshold,
          .provenance = {}};
}

std::string to_text(const SearchDescription& description) {
  Json json;
  json["format"] = kFormat;
  json["normalisation"] = "none";
  write(description, json);
  return json.dump();
}

SearchDescription from_text(std::string_view text) {
  try {
    return checked(Json::parse(text));
  } catch (const BadInput& e) {
    throw BadInput(std::string("search description: ") + e.what());
  } catch (const Json::exception& e) {
    throw BadInput("search description: " + to_string(e));
  }
}

}  // namespace earshot::description
