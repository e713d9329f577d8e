#pragma once

#include <algorithm>
#include <array>

#include "firmware/messages/dictionary/message.hpp"
#include "firmware/messages/dictionary/safety_words.hpp"
#include "firmware/messages/journal_records.hpp"

namespace earshot::messages {

// The mission as its journal keeps it, with fence, zones and rules of the safety supervisor.

/// The supervisor's polygons, in the places of one array: fence (inside, save, halt), then zones where the vehicle may not surface. A
/// polygon without corners is none.
struct Polygons : Line {
  using Safety = At<&MissionRecord::mission, &config::Mission::safety>;
  using Reaches = Types<At<&MissionRecord::mission, &config::Mission::safety, &config::Safety::fence>,
                        At<&MissionRecord::mission, &config::Mission::safety, &config::Safety::no_surface>>;
  static constexpr std::size_t kFirstZone = 3;
  static constexpr std::size_t kPlaces = kFirstZone + config::kMaxNoSurfaceZones;
  static constexpr std::size_t kCorners = config::kMaxPolygonCorners;

  [[nodiscard]] constexpr std::array<NumberField, 3> numbers() const {
    return {{{.type = NumberType::kInt8, .name = "corners", .sizes = {kPlaces, 0}},
             {.type = NumberType::kDouble, .name = "corner_north_m", .sizes = {kPlaces, kCorners}},
             {.type = NumberType::kDouble, .name = "corner_east_m", .sizes = {kPlaces, kCorners}}}};
  }

  /// Null: there is none in that place.
  static constexpr auto* polygon_at(auto& safety, std::size_t place) {
    auto* const inside = safety.fence ? &safety.fence->inside : nullptr;
    if (place >= kFirstZone) return place - kFirstZone < safety.no_surface.size() ? &safety.no_surface[place - kFirstZone] : nullptr;
    if (!safety.fence || place == 0) return inside;
    return place == 1 ? &safety.fence->save : &safety.fence->halt;
  }

  static constexpr void write(const MissionRecord& record, auto& out) {
    const config::Safety& safety = *Safety::in(record);
    for (std::size_t place = 0; place < kPlaces; ++place) {
      const config::Polygon* const polygon = polygon_at(safety, place);
      out.number(static_cast<std::int8_t>(polygon != nullptr ? polygon->size() : 0));
    }
    for (const auto coordinate : {&NorthEast::north, &NorthEast::east}) {
      for (std::size_t place = 0; place < kPlaces; ++place) {
        const config::Polygon* const polygon = polygon_at(safety, place);
        for (std::size_t i = 0; i < kCorners; ++i)
          out.number(polygon != nullptr && i < polygon->size() ? ((*polygon)[i].*coordinate).value : 0.0);
      }
    }
  }

  static constexpr void hear(auto& in, MissionRecord& record) {
    config::Safety& safety = *Safety::in(record);
    std::array<std::size_t, kPlaces> corners{};
    for (std::size_t& count : corners)
      count = static_cast<std::size_t>(std::clamp<int>(in.template number<std::int8_t>(), 0, static_cast<int>(kCorners)));
    if (corners[0] > 0) safety.fence.emplace();
    for (std::size_t place = kFirstZone; place < kPlaces && corners[place] > 0; ++place)
      static_cast<void>(safety.no_surface.push_back({}));  // there is room
    for (const auto coordinate : {&NorthEast::north, &NorthEast::east}) {
      for (std::size_t place = 0; place < kPlaces; ++place) {
        config::Polygon* const polygon = polygon_at(safety, place);
        for (std::size_t i = 0; i < kCorners; ++i) {
          const auto number = in.template number<double>();
          if (polygon == nullptr || i >= corners[place]) continue;
          if (i == polygon->size()) static_cast<void>(polygon->push_back({}));  // there is room
          ((*polygon)[i].*coordinate).value = number;
        }
      }
    }
  }
};

/// The mission's own rules, as columns of arrays. How many of them count stands before them.
struct RuleColumns : Line {
  using Rules = At<&MissionRecord::mission, &config::Mission::safety, &config::Safety::rules>;
  using Reaches = Types<Rules>;
  using Element = config::Rule;
  static constexpr std::size_t kRules = config::kMaxOwnRules;

  [[nodiscard]] constexpr std::array<NumberField, 6> numbers() const {
    return {{{.type = NumberType::kInt8, .name = "rules"},
             {.type = NumberType::kInt8, .name = "rule_condition", .sizes = {kRules, 0}},
             {.type = NumberType::kDouble, .name = "rule_limit", .sizes = {kRules, 0}},
             {.type = NumberType::kInt64, .name = "rule_persistence_us", .sizes = {kRules, 0}},
             {.type = NumberType::kInt8, .name = "rule_response", .sizes = {kRules, 0}},
             {.type = NumberType::kBoolean, .name = "rule_latched", .sizes = {kRules, 0}}}};
  }

  using Columns = Types<Scalar<At<&config::Rule::condition>>, Scalar<At<&config::Rule::limit>>, Scalar<At<&config::Rule::persistence>>,
                        Scalar<At<&config::Rule::response>>, Scalar<At<&config::Rule::is_latched>>>;

  static constexpr void write(const MissionRecord& record, auto& out) {
    const auto& rules = *Rules::in(record);
    out.number(static_cast<std::int8_t>(rules.size()));
    const auto write_column = [&]<class Column>(Types<Column>) {
      for (const config::Rule& rule : rules) Column::write(rule, out);
      for (std::size_t i = rules.size(); i < kRules; ++i) out.number(typename Column::Number{});
    };
    [&]<class... Column>(Types<Column...>) { (write_column(Types<Column>{}), ...); }(Columns{});
  }
  static constexpr void hear(auto& in, MissionRecord& record) {
    auto& rules = *Rules::in(record);
    const int count = std::min<int>(in.template number<std::int8_t>(), static_cast<int>(kRules));
    for (int i = 0; i < count; ++i) static_cast<void>(rules.push_back({}));  // there is room
    const auto hear_column = [&]<class Column>(Types<Column>) {
      for (config::Rule& rule : rules) Column::hear(in, rule);
      for (std::size_t i = rules.size(); i < kRules; ++i) static_cast<void>(in.template number<typename Column::Number>());
    };
    [&]<class... Column>(Types<Column...>) { (hear_column(Types<Column>{}), ...); }(Columns{});
  }
};

namespace detail {

/// A field of the mission.
template <auto... kSteps>
consteval auto of_mission(std::string_view name, FieldFormat format = {}) {
  return field<&MissionRecord::mission, kSteps...>(name, format);
}
/// Of the vehicle's limits.
template <auto kMember>
consteval auto of_vehicle(std::string_view name) {
  return field<&MissionRecord::mission, &config::Mission::safety, &config::Safety::vehicle, kMember>(name, {.group = "vehicle"});
}

}  // namespace detail

template <>
struct Described<MissionRecord> {
  using Mission = config::Mission;
  using Vehicle = config::VehicleLimits;
  static constexpr std::string_view kType = "mission_t";
  static constexpr std::string_view kChannel = "EARSHOT_MISSION";
  static constexpr std::string_view kMeaning =
      "What is flown: the first record of a journal. The second, on EARSHOT_POLICY, holds the bytes of the .policy file, the third, on\n"
      "EARSHOT_TABLES, those of the .tables file: none, where the policy does not search by any.";
  static constexpr LineList kFields{
      sent_time("utime"),
      detail::of_mission<&Mission::operating_area, &Rectangle::south_west, &NorthEast::north>("south_m", {.meaning = "operating area"}),
      detail::of_mission<&Mission::operating_area, &Rectangle::south_west, &NorthEast::east>("west_m"),
      detail::of_mission<&Mission::operating_area, &Rectangle::north_east, &NorthEast::north>("north_m"),
      detail::of_mission<&Mission::operating_area, &Rectangle::north_east, &NorthEast::east>("east_m"),
      detail::of_mission<&Mission::edge_margin>("edge_margin_m"),
      detail::of_mission<&Mission::search_depth>("search_depth_m"),
      detail::of_mission<&Mission::max_depth>("max_depth_m"),
      detail::of_mission<&Mission::search_speed>("search_speed_mps"),
      detail::of_mission<&Mission::step_length>("step_length_m"),
      detail::of_mission<&Mission::max_steps>("max_steps"),
      detail::of_mission<&Mission::ends_when_found>("ends_when_found"),
      detail::of_mission<&Mission::max_time>("max_time_us", {.key = "max_time_s"}),
      detail::of_mission<&Mission::navigation_timeout>("navigation_timeout_us", {.key = "navigation_timeout_s"}),
      detail::of_mission<&Mission::snr_timeout>("snr_timeout_us", {.key = "snr_timeout_s"}),
      detail::of_mission<&Mission::detection_threshold>("detection_threshold_db"),
      detail::of_mission<&Mission::source_frequency>("source_frequency_hz"),
      Polygons{{"",
                {.heading = "Of the safety supervisor: fence (inside, save, halt) and zones where the vehicle may not surface. `corners` "
                            "of each polygon; 0: there is none."}}},
      whether_there<&MissionRecord::mission, &Mission::safety, &config::Safety::safe_point>("has_safe_point", {.is_in_files = false}),
      detail::of_mission<&Mission::safety, &config::Safety::safe_point, &NorthEast::north>("safe_point_north_m"),
      detail::of_mission<&Mission::safety, &config::Safety::safe_point, &NorthEast::east>("safe_point_east_m"),
      detail::of_vehicle<&Vehicle::max_speed>("vehicle_max_speed_mps"),
      detail::of_vehicle<&Vehicle::max_current>("vehicle_max_current_mps"),
      detail::of_vehicle<&Vehicle::turn_radius>("vehicle_turn_radius_m"),
      detail::of_vehicle<&Vehicle::hold_speed>("vehicle_hold_speed_mps"),
      detail::of_vehicle<&Vehicle::ascent_speed>("vehicle_ascent_speed_mps"),
      detail::of_vehicle<&Vehicle::ascent_rate>("vehicle_ascent_rate_mps"),
      detail::of_vehicle<&Vehicle::surface_depth>("vehicle_surface_depth_m"),
      detail::of_vehicle<&Vehicle::battery_percent_per_km>("vehicle_battery_percent_per_km"),
      RuleColumns{
          {"rules", {.heading = "How many of the rules below are in use; Condition and Response are of firmware/config/safety.hpp."}}},
      detail::of_mission<&Mission::authority, &config::Authority::needs_verified_commands>("needs_verified_commands"),
      detail::of_mission<&Mission::authority, &config::Authority::autopilot_timeout>(
          "autopilot_timeout_us", {.meaning = "0: its status is not waited for", .key = "autopilot_timeout_s"}),
      detail::of_mission<&Mission::listening, &config::ListeningWindow::listening>(
          "listening", {.meaning = "what an observation hears of the SNR measurements on its leg: 0 the newest, 1 the loudest, 2 the "
                                   "mean of those measured"}),
      detail::of_mission<&Mission::listening, &config::ListeningWindow::length>("listening_window_us", {.key = "listening_window_s"}),
      detail::of_mission<&Mission::action_seed>("action_seed"),
      field<&MissionRecord::policy_crc32>("policy_crc32", {.meaning = "of the whole .policy file", .is_checksum = true}),
      field<&MissionRecord::tables_crc32>("tables_crc32", {.meaning = "of the whole .tables file; 0: none", .is_checksum = true}),
      text<&MissionRecord::build>("build", {.meaning = "version and commit of the program, padded with zeros"}),
  };
};

}  // namespace earshot::messages
