#include "firmware/desk/journal_view/export/fields.hpp"

#include <array>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "firmware/host/file/checksum_text.hpp"
#include "firmware/host/journal/words/wording.hpp"
#include "firmware/host/text/numbers.hpp"
#include "firmware/messages/dictionary/every_message.hpp"

namespace earshot::journal {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

// One value.

template <class Unit>
Json json_of(Quantity<Unit> quantity) {
  return quantity.value;
}
Json json_of(Time time) {
  return seconds_of(time);
}
Json json_of(Duration duration) {
  return static_cast<double>(duration.us) / 1e6;  // 0.007, not 0.006999999999999999
}
/// A value that this program does not know is its number.
template <messages::HasWords Enum>
Json json_of(Enum value) {
  const messages::Word<Enum>* const word = messages::word_of(value);
  return word != nullptr ? Json(word->*messages::WordsOf<Enum>::kInRecords) : Json(std::to_string(static_cast<int>(value)));
}
template <class Number>
requires std::is_arithmetic_v<Number> Json json_of(Number number) {
  return number;
}
template <class Enum>
requires(std::is_enum_v<Enum> && !messages::HasWords<Enum>) Json json_of(Enum value) {
  return static_cast<int>(value);
}

template <messages::IsDescribed Message>
Json fields(const Message& message);

// One line of a message's list: what is missing is NaN, or false.

template <class Place>
Json json_in(const messages::Scalar<Place>& line, const auto& message) {
  using Value = typename messages::Scalar<Place>::Value;
  const Value* const value = messages::Scalar<Place>::value_in(message);
  if constexpr (std::is_same_v<Value, std::uint32_t>) {
    if (line.format.is_checksum && value != nullptr) return host::crc32_text(*value);
  }
  if constexpr (std::is_integral_v<Value> && !std::is_same_v<Value, bool>) {
    if (line.format.counts_from_one_in_files && value != nullptr) return *value + 1;
  }
  if constexpr (std::is_same_v<Value, bool>) {
    return value != nullptr && *value;
  } else {
    return value != nullptr ? json_of(*value) : Json(kUnknown);
  }
}

template <class Place>
Json json_in(const messages::Presence<Place>& /*line*/, const auto& message) {
  const auto* const value = Place::in(message);
  return value != nullptr && value->has_value();
}

template <class Place>
Json json_in(const messages::OptionalNumber<Place>& /*line*/, const auto& message) {
  const auto* const value = Place::in(message);
  return value != nullptr && value->has_value() ? json_of(**value) : Json(kUnknown);
}

/// Two hexadecimal digits a byte.
template <class Place>
Json json_in(const messages::Bytes<Place>& /*line*/, const auto& message) {
  std::string digits;
  for (const std::uint8_t byte : *Place::in(message)) digits += host::formatted("%02x", unsigned{byte});
  return digits;
}

template <class Place>
Json json_in(const messages::Text<Place>& /*line*/, const auto& message) {
  return messages::text_of(*Place::in(message));
}

template <class Place, class Count, std::size_t kOutside>
Json json_in(const messages::Floats<Place, Count, kOutside>& /*line*/, const auto& message) {
  const std::span<const float> floats = messages::counted(*Place::in(message), *Count::in(message));
  return std::vector<float>(floats.begin(), floats.end());
}

template <class Place>
Json json_in(const messages::Nested<Place>& /*line*/, const auto& message) {
  Json all = Json::array();
  for (const auto& element : *Place::in(message)) all.push_back(fields(element));
  return all;
}

Json json_in(const messages::MarkWorth& /*line*/, const messages::OperatorCommand& command) {
  return command.is_verified;
}

Json corners_of(const config::Polygon* polygon) {
  Json corners = Json::array();
  if (polygon == nullptr) return corners;
  for (const NorthEast& corner : *polygon) corners.push_back({{"north_m", corner.north.value}, {"east_m", corner.east.value}});
  return corners;
}

Json json_in(const messages::RuleColumns& /*line*/, const messages::MissionRecord& record) {
  Json rules = Json::array();
  for (const config::Rule& rule : record.mission.safety.rules)
    rules.push_back({{"condition", json_of(rule.condition)},
                     {"limit", rule.limit},
                     {"persistence_s", json_of(rule.persistence)},
                     {"response", json_of(rule.response)},
                     {"latched", rule.is_latched}});
  return rules;
}

/// "vehicle_turn_radius_m" in the group "vehicle" is its "turn_radius_m".
void put(const messages::Line& line, Json value, Json& json) {
  const std::string key(line.format.key.empty() ? line.name : line.format.key);
  if (line.format.group.empty())
    json[key] = std::move(value);
  else
    json[std::string(line.format.group)][key.substr(line.format.group.size() + 1)] = std::move(value);
}

void add(const auto& line, const auto& message, Json& json) {
  if constexpr (requires { json_in(line, message); }) put(line, json_in(line, message), json);
}

void add(const messages::Polygons& /*line*/, const messages::MissionRecord& record, Json& json) {
  const config::Safety& safety = record.mission.safety;
  constexpr std::array kFence{"fence_inside", "fence_save", "fence_halt"};
  for (std::size_t place = 0; place < kFence.size(); ++place)
    json[kFence.at(place)] = corners_of(messages::Polygons::polygon_at(safety, place));
  Json zones = Json::array();
  for (const config::Polygon& zone : safety.no_surface) zones.push_back(corners_of(&zone));
  json["no_surface_zones"] = std::move(zones);
}

template <messages::IsDescribed Message>
Json fields(const Message& message) {
  Json json = Json::object();
  messages::for_each_line<Message>([&](const auto& line) {
    if (line.format.is_in_files) add(line, message, json);
  });
  return json;
}

// What a record says.

Json fields(const Unreadable& /*unreadable*/) {
  return nullptr;
}

Json fields(const PolicyBytes& policy) {
  return {{"bytes", policy.bytes.size()}, {"crc32", host::crc32_text(policy.crc32)}};
}

Json fields(const TablesBytes& tables) {
  return {{"bytes", tables.bytes.size()}, {"crc32", host::crc32_text(tables.crc32)}};
}

Json fields(const messages::Input& input) {
  Json json{{"port", input.port}};
  json.update(std::visit([](const auto& value) { return fields(value); }, input.value));
  return json;
}

// What a record may say.

/// Hears a one in place of every number: what may be missing is there then, and each list holds an element.
struct Ones {
  template <class Number>
  Number number() {
    return static_cast<Number>(1);
  }
  template <messages::IsDescribed Message>
  void message(Message& message) {
    messages::for_each_line_type<Message>([&]<class Line>() {
      if constexpr (!std::is_same_v<Line, messages::SentTime>) Line::hear(*this, message);
    });
  }
  template <messages::IsDescribed Message>
  void pass_over() {}
};

template <class Value>
Json all_fields(const Value& value) {
  if constexpr (std::is_same_v<Value, messages::Input>) {
    messages::Input full = value;
    std::visit([](auto& of_full) { Ones{}.message(of_full = {}); }, full.value);
    return fields(full);
  } else if constexpr (messages::IsDescribed<Value>) {
    Value full;
    Ones{}.message(full);
    return fields(full);
  } else {
    return fields(value);
  }
}

}  // namespace

nlohmann::ordered_json fields_of(const Content& content) {
  return std::visit([](const auto& value) { return fields(value); }, content);
}

nlohmann::ordered_json all_fields_of(const Content& content) {
  return std::visit([](const auto& value) { return all_fields(value); }, content);
}

const char* topic_of(const Content& content) {
  // In the order of the alternatives.
  static constexpr std::array<const char*, std::variant_size_v<Content>> kTopics{
      "unknown",  "mission",     "policy",          "",
      "setpoint", "decision",    "safety_event",    "acknowledgement",
      "health",   "journal_end", "journal_resumed", "controller_trouble",
      "tables",   "detection",   "challenge"};
  static constexpr std::array<const char*, std::variant_size_v<decltype(messages::Input::value)>> kInputTopics{
      "navigation",        "snr",     "order",           "port_report", "vehicle_status", "autopilot_status",
      "hydrophone_status", "bearing", "unsent_setpoints"};
  static_assert(std::is_same_v<std::variant_alternative_t<3, Content>, messages::Input>);
  if (const auto* const input = std::get_if<messages::Input>(&content)) return kInputTopics.at(input->value.index());
  return kTopics.at(content.index());
}

std::string to_line(const nlohmann::ordered_json& json) {
  return json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

}  // namespace earshot::journal
