#include "firmware/boards/linux/journal_view/export/fields.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>
#include <iterator>
#include <limits>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "firmware/boards/linux/journal_view/wording.hpp"
#include "firmware/host/file/checksum_text.hpp"
#include "firmware/messages/dictionary/command_words.hpp"
#include "firmware/messages/dictionary/mission_words.hpp"
#include "firmware/messages/dictionary/safety_words.hpp"
#include "firmware/wire/lcm/conversion.hpp"

namespace earshot::journal_view {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

double seconds_at(std::int64_t us) {
  return seconds_of(Time{us});
}

/// A word of a table, or its number where the table has none.
template <std::size_t N>
Json word_at(const std::array<std::string_view, N>& words, std::size_t index) {
  return index < N ? Json(words.at(index)) : Json(std::to_string(index));
}

/// How a value is called, or its number where there is no such value.
template <messages::HasWords Enum>
Json called(std::string_view messages::Word<Enum>::*how, Enum value) {
  const messages::Word<Enum>* const word = messages::word_of(value);
  return word != nullptr ? Json(word->*how) : Json(std::to_string(static_cast<int>(value)));
}

template <messages::HasWords Enum>
Json key_at(Enum value) {
  return called(&messages::Word<Enum>::key, value);
}

/// Sizes are whatever the bytes say, the arrays are not.
template <class Value, std::size_t N>
std::span<const Value> first_of(const Value (&values)[N], std::int8_t count) {
  return std::span(values).first(std::min(N, static_cast<std::size_t>(std::max<std::int8_t>(count, 0))));
}

Json numbers(std::span<const float> values) {
  return std::vector<float>(values.begin(), values.end());
}

Json input_fields(const messages::Navigation& m) {
  return {{"valid_time_s", seconds_of(m.time)}, {"north_m", m.position.north.value}, {"east_m", m.position.east.value},
          {"depth_m", m.depth.value},           {"heading_rad", m.heading.value},    {"speed_mps", m.speed.value}};
}

Json input_fields(const messages::SnrMeasurement& m) {
  return {{"valid_time_s", seconds_of(m.time)}, {"snr_db", m.snr.value}, {"too_faint", m.too_faint}};
}

/// What a bearing that is not there says, too.
Json bearing_fields(const std::optional<messages::Bearing>& bearing) {
  const messages::Bearing& b = bearing.value_or(messages::Bearing{.direction = Radians{kUnknown}, .deviation = Radians{kUnknown}});
  return {{"bearing_rad", b.direction.value},
          {"bearing_deviation_rad", b.deviation.value},
          {"bearing_ambiguous", b.mirror_axis.has_value()},
          {"bearing_axis_rad", b.mirror_axis.value_or(Radians{kUnknown}).value}};
}

Json input_fields(const messages::BearingMeasurement& m) {
  Json json{{"valid_time_s", seconds_of(m.time)}};
  json.update(bearing_fields(m.bearing));
  json["sender"] = m.sender;
  return json;
}

Json input_fields(const messages::OperatorCommand& m) {
  return {{"given_time_s", seconds_of(m.time)},
          {"expiry_time_s", seconds_of(m.expiry)},
          {"issuer", m.issuer},
          {"number", m.number},
          {"order", messages::to_string(m.order)},
          {"max_depth_m", m.limits.max_depth ? m.limits.max_depth->value : kUnknown},
          {"max_speed_mps", m.limits.max_speed ? m.limits.max_speed->value : kUnknown},
          {"max_time_s", m.limits.max_time_s.value_or(kUnknown)},
          {"verified", m.is_verified}};
}

Json report_fields(std::int64_t port, bool link_up, std::uint64_t received, std::uint64_t lost, std::uint64_t malformed,
                   std::uint64_t unsent) {
  return {{"reported_port", port}, {"link_up", link_up},     {"received", received},
          {"lost", lost},          {"malformed", malformed}, {"unsent", unsent}};
}

Json input_fields(const messages::PortReport& m) {
  return report_fields(m.port, m.link_up, m.received, m.lost, m.malformed, m.unsent);
}

Json input_fields(const messages::UnsentSetpoints& m) {
  return {{"count", m.count}};
}

Json input_fields(const messages::VehicleStatus& m) {
  return {{"valid_time_s", seconds_of(m.time)},
          {"altitude_m", m.altitude.value},
          {"battery_percent", m.battery_percent},
          {"leak", m.has_leak},
          {"ground_fault", m.has_ground_fault}};
}

Json input_fields(const messages::AutopilotStatus& m) {
  return {{"valid_time_s", seconds_of(m.time)}, {"follows_setpoints", m.follows_setpoints}};
}

Json input_fields(const messages::HydrophoneStatus& m) {
  return {{"valid_time_s", seconds_of(m.time)}, {"deaf", m.is_deaf}};
}

/// @param bytes  padded with zeros
std::string build_of(std::span<const std::uint8_t> bytes) {
  return {bytes.begin(), std::ranges::find(bytes, 0)};
}

Json fields(const Unreadable& /*unreadable*/) {
  return nullptr;
}

Json fields(const PolicyBytes& policy) {
  return {{"bytes", policy.size}, {"crc32", host::crc32_text(policy.crc32)}};
}

Json fields(const TablesBytes& tables) {
  return {{"bytes", tables.size}, {"crc32", host::crc32_text(tables.crc32)}};
}

Json fields(const messages::Input& input) {
  Json json{{"port", input.port}};
  json.update(std::visit([](const auto& value) { return input_fields(value); }, input.value));
  return json;
}

Json fields(const messages::Setpoint& m) {
  return {{"heading_rad", m.heading.value},
          {"speed_mps", m.speed.value},
          {"depth_m", m.depth.value},
          {"waypoint_north_m", m.waypoint.north.value},
          {"waypoint_east_m", m.waypoint.east.value},
          {"release_weight", m.release_weight}};
}

Json polygon(const mission_t& m, std::size_t place) {
  Json corners = Json::array();
  const std::size_t count = first_of(m.corner_north_m[place], m.corners[place]).size();
  for (std::size_t i = 0; i < count; ++i)
    corners.push_back({{"north_m", m.corner_north_m[place][i]}, {"east_m", m.corner_east_m[place][i]}});
  return corners;
}

Json rules(const mission_t& m) {
  Json rules = Json::array();
  const std::size_t count = first_of(m.rule_limit, m.rules).size();
  for (std::size_t i = 0; i < count; ++i)
    rules.push_back({{"condition", key_at(static_cast<config::Condition>(m.rule_condition[i]))},
                     {"limit", m.rule_limit[i]},
                     {"persistence_s", seconds_at(m.rule_persistence_us[i])},
                     {"response", key_at(static_cast<config::Response>(m.rule_response[i]))},
                     {"latched", m.rule_latched[i] != 0}});
  return rules;
}

Json vehicle(const mission_t& m) {
  return {{"max_speed_mps", m.vehicle_max_speed_mps},       {"max_current_mps", m.vehicle_max_current_mps},
          {"turn_radius_m", m.vehicle_turn_radius_m},       {"hold_speed_mps", m.vehicle_hold_speed_mps},
          {"ascent_speed_mps", m.vehicle_ascent_speed_mps}, {"ascent_rate_mps", m.vehicle_ascent_rate_mps},
          {"surface_depth_m", m.vehicle_surface_depth_m},   {"battery_percent_per_km", m.vehicle_battery_percent_per_km}};
}

Json fields(const mission_t& m) {
  Json zones = Json::array();
  constexpr std::size_t kFirstZone = 3;  // behind inside, save and halt
  for (std::size_t place = kFirstZone; place < std::size(m.corners); ++place)
    if (m.corners[place] > 0) zones.push_back(polygon(m, place));
  return {{"south_m", m.south_m},
          {"west_m", m.west_m},
          {"north_m", m.north_m},
          {"east_m", m.east_m},
          {"edge_margin_m", m.edge_margin_m},
          {"search_depth_m", m.search_depth_m},
          {"max_depth_m", m.max_depth_m},
          {"search_speed_mps", m.search_speed_mps},
          {"step_length_m", m.step_length_m},
          {"max_steps", m.max_steps},
          {"max_time_s", seconds_at(m.max_time_us)},
          {"navigation_timeout_s", seconds_at(m.navigation_timeout_us)},
          {"snr_timeout_s", seconds_at(m.snr_timeout_us)},
          {"detection_threshold_db", m.detection_threshold_db},
          {"fence_inside", polygon(m, 0)},
          {"fence_save", polygon(m, 1)},
          {"fence_halt", polygon(m, 2)},
          {"no_surface_zones", std::move(zones)},
          {"safe_point_north_m", m.has_safe_point != 0 ? m.safe_point_north_m : kUnknown},
          {"safe_point_east_m", m.has_safe_point != 0 ? m.safe_point_east_m : kUnknown},
          {"vehicle", vehicle(m)},
          {"rules", rules(m)},
          {"needs_verified_commands", m.needs_verified_commands != 0},
          {"autopilot_timeout_s", seconds_at(m.autopilot_timeout_us)},
          {"listening", m.listening},
          {"listening_window_s", seconds_at(m.listening_window_us)},
          {"action_seed", m.action_seed},
          {"policy_crc32", host::crc32_text(static_cast<std::uint32_t>(m.policy_crc32))},
          {"tables_crc32", host::crc32_text(static_cast<std::uint32_t>(m.tables_crc32))},
          {"build", build_of(m.build)}};
}

Json fields(const decision_t& m) {
  const bool believes = m.believes != 0;
  const bool is_found = m.found != 0;
  Json json{{"step", m.step},
            {"north_m", m.north_m},
            {"east_m", m.east_m},
            {"snr_db", m.snr_db},
            {"too_faint", m.too_faint != 0},
            {"detected", m.detected != 0},
            {"action", m.action},
            {"sweeping", m.sweeping != 0},
            {"overridden", m.overridden != 0},
            {"waypoint_north_m", m.waypoint_north_m},
            {"waypoint_east_m", m.waypoint_east_m},
            {"observation", numbers(first_of(m.observation, m.observation_size))},
            {"logits", numbers(first_of(m.logits, m.action_count))},
            {"believes", believes},
            {"likeliest_north_m", believes ? m.likeliest_north_m : kUnknown},
            {"likeliest_east_m", believes ? m.likeliest_east_m : kUnknown},
            {"mean_north_m", believes ? m.mean_north_m : kUnknown},
            {"mean_east_m", believes ? m.mean_east_m : kUnknown},
            {"spread_m", believes ? m.spread_m : kUnknown},
            {"likeliest_share", believes ? double{m.likeliest_share} : kUnknown},
            {"effective_cells", believes ? double{m.effective_cells} : kUnknown},
            {"surprise_bits", believes ? double{m.surprise_bits} : kUnknown},
            {"found", is_found},
            {"found_probability", is_found ? double{m.found_probability} : kUnknown},
            {"found_least_snr_db", is_found ? m.found_least_snr_db : kUnknown},
            {"closest_approach_m", is_found ? m.closest_approach_m : kUnknown}};
  json.update(bearing_fields(wire::bearing_in(m)));
  return json;
}

Json fields(const messages::SafetyEvent& m) {
  return {{"rule", m.rule + 1},
          {"condition", key_at(m.condition)},
          {"response", key_at(m.response)},
          {"begins", m.begins},
          {"measure", m.measure},
          {"limit", m.limit}};
}

Json fields(const command_acknowledgement_t& m) {
  return {{"issuer", static_cast<std::uint32_t>(m.issuer)},
          {"number", static_cast<std::uint32_t>(m.number)},
          {"order", messages::to_string(static_cast<messages::Order>(m.command))},
          {"outcome", messages::to_string(static_cast<messages::CommandOutcome>(m.outcome))}};
}

Json fields(const health_t& m) {
  Json ports = Json::array();
  for (const port_report_t& p : first_of(m.ports, m.port_count)) {
    ports.push_back(report_fields(p.port, p.link_up != 0, static_cast<std::uint64_t>(p.received), static_cast<std::uint64_t>(p.lost),
                                  static_cast<std::uint64_t>(p.malformed), static_cast<std::uint64_t>(p.unsent)));
  }
  return {{"turn", m.turn},
          {"state", messages::to_string(static_cast<messages::MissionState>(m.state))},
          {"authority", called(&messages::Word<messages::Authority>::name, static_cast<messages::Authority>(m.authority))},
          {"paused", m.paused != 0},
          {"end_reason", messages::to_string(static_cast<messages::EndReason>(m.end_reason))},
          {"decisions", m.decisions},
          {"steps_taken", m.steps_taken},
          {"surprise_bits", m.surprise_bits},
          {"sweeping", m.sweeping != 0},
          {"found", m.found != 0},
          {"response", key_at(static_cast<config::Response>(m.response))},
          {"navigation_refused", m.navigation_refused},
          {"snr_refused", m.snr_refused},
          {"status_refused", m.status_refused},
          {"commands_refused", m.commands_refused},
          {"setpoints_limited", m.setpoints_limited},
          {"bearings_refused", m.bearings_refused},
          {"bearings_of_others", m.bearings_of_others},
          {"ports", std::move(ports)}};
}

Json fields(const wire::ClosingRecord& m) {
  static constexpr std::array<std::string_view, 3> kEndingWords{"mission over", "stopped", "clock lost"};
  return {{"ending", word_at(kEndingWords, static_cast<std::size_t>(m.ending))},
          {"state", messages::to_string(m.state)},
          {"end_reason", messages::to_string(m.end_reason)},
          {"steps_taken", m.steps_taken},
          {"streams_lost", m.lost.streams},
          {"steering_lost", m.lost.steering},
          {"orders_lost", m.lost.orders}};
}

Json fields(const journal_resumed_t& m) {
  return {{"cut_bytes", m.cut_bytes}, {"build", build_of(m.build)}};
}

Json fields(const controller_trouble_t& m) {
  static constexpr std::array<std::string_view, 2> kWords{"error passive", "bus off"};
  return {{"port", m.port}, {"trouble", word_at(kWords, static_cast<std::uint8_t>(m.trouble))}, {"is_there", m.is_there != 0}};
}

}  // namespace

nlohmann::ordered_json fields_of(const Content& content) {
  return std::visit([](const auto& value) { return fields(value); }, content);
}

const char* topic_of(const Content& content) {
  // In the order of the alternatives.
  static constexpr std::array<const char*, std::variant_size_v<Content>> kTopics{
      "unknown",  "mission",     "policy",          "",
      "setpoint", "decision",    "safety_event",    "acknowledgement",
      "health",   "journal_end", "journal_resumed", "controller_trouble",
      "tables"};
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

}  // namespace earshot::journal_view
