#include "policy/report/document/turn_rows.hpp"

#include <utility>

#include "firmware/core/compass.hpp"
#include "policy/report/document/json_values.hpp"

namespace earshot::report {

using nlohmann::ordered_json;

void TurnRows::take(const messages::Input& input) {
  if (const auto* const fix = std::get_if<messages::Navigation>(&input.value); fix != nullptr && messages::is_usable(*fix)) fix_ = *fix;
  if (const auto* const snr = std::get_if<messages::SnrMeasurement>(&input.value); snr != nullptr && messages::is_possible_snr(snr->snr))
    snr_ = *snr;
  if (const auto* const status = std::get_if<messages::VehicleStatus>(&input.value))
    battery_percent_ = messages::usable_part_of(*status).battery_percent;
}

void TurnRows::take(const config::Mission& mission) {
  navigation_timeout_ = mission.navigation_timeout;
  snr_timeout_ = mission.snr_timeout;
}

void TurnRows::expect(std::shared_ptr<const Expectation> expectation, bool has_belief) {
  expectations_.push_back(std::move(expectation));
  has_belief_ = has_belief;
}

void TurnRows::take(Time time, const messages::Health& health) {
  Turn turn{.time_s = (time - began_).to_seconds(), .battery_percent = battery_percent_, .expectation = expectations_.size()};
  if (fix_ && time - fix_->time <= navigation_timeout_) {
    turn.place = fix_->position;
    turn.depth_m = fix_->depth.value;
    turn.heading_deg = compass_degrees(fix_->heading);
    turn.speed_mps = fix_->speed.value;
  }
  if (snr_ && time - snr_->time <= snr_timeout_) {
    turn.snr_db = snr_->snr.value;
    turn.is_too_faint = snr_->too_faint;
  }
  if (const std::optional<messages::Setpoint> set = std::exchange(setpoint_, std::nullopt)) {
    turn.depth_set_m = set->depth.value;
    turn.heading_set_deg = compass_degrees(set->heading);
    turn.speed_set_mps = set->speed.value;
    turn.waypoint = set->waypoint;
  }
  if (has_belief_) turn.mismatch_bits = double{health.mismatch_bits};
  turns_.push_back(turn);
}

void TurnRows::settle_expectation(Turn& turn) const {
  if (std::exchange(turn.is_expectation_settled, true) || turn.expectation == 0 || !is_finite(turn.place)) return;
  const std::shared_ptr<const Expectation>& last = expectations_[turn.expectation - 1];
  if (last) turn.expected_snr_db = explain::expected_hearing(last->place, last->sound, turn.place - last->south_west).snr.value;
}

ordered_json TurnRows::strips(std::size_t first, std::size_t most) {
  constexpr int kTenths = 1;
  constexpr int kHundredths = 2;
  struct Column {
    const char* name;
    ordered_json (*value)(const Turn& turn);
  };
  static constexpr Column kColumns[] = {
      {"time_s", [](const Turn& turn) { return rounded(turn.time_s, kTenths); }},
      {"north_m", [](const Turn& turn) { return rounded(turn.place.north.value, kTenths); }},
      {"east_m", [](const Turn& turn) { return rounded(turn.place.east.value, kTenths); }},
      {"depth_m", [](const Turn& turn) { return rounded(turn.depth_m, kTenths); }},
      {"heading_deg", [](const Turn& turn) { return rounded_compass(turn.heading_deg); }},
      {"speed_mps", [](const Turn& turn) { return rounded(turn.speed_mps, kHundredths); }},
      {"depth_set_m", [](const Turn& turn) { return rounded(turn.depth_set_m, kTenths); }},
      {"heading_set_deg", [](const Turn& turn) { return rounded_compass(turn.heading_set_deg); }},
      {"speed_set_mps", [](const Turn& turn) { return rounded(turn.speed_set_mps, kHundredths); }},
      {"waypoint_north_m", [](const Turn& turn) { return rounded(turn.waypoint.north.value, kTenths); }},
      {"waypoint_east_m", [](const Turn& turn) { return rounded(turn.waypoint.east.value, kTenths); }},
      {"snr_db", [](const Turn& turn) { return rounded(turn.snr_db, kHundredths); }},
      {"snr_too_faint", [](const Turn& turn) { return is_finite(turn.snr_db) ? ordered_json(turn.is_too_faint) : ordered_json(); }},
      {"expected_snr_db", [](const Turn& turn) { return rounded(turn.expected_snr_db, kHundredths); }},
      {"mismatch_bits", [](const Turn& turn) { return rounded(turn.mismatch_bits, kHundredths); }},
      {"battery_percent", [](const Turn& turn) { return rounded(turn.battery_percent, kTenths); }},
      {"turn_time_ms", [](const Turn&) { return ordered_json(); }},  // no record has it
  };
  const std::size_t count = turns_.size() - first;
  const std::size_t stride = count == 0 ? 1 : (count + most - 1) / most;
  const std::size_t begin = first + (count == 0 ? 0 : (count - 1) % stride);
  for (std::size_t i = begin; i < turns_.size(); i += stride) settle_expectation(turns_[i]);
  ordered_json strips;
  for (const Column& column : kColumns) {
    ordered_json values = ordered_json::array();
    for (std::size_t i = begin; i < turns_.size(); i += stride) values.push_back(column.value(turns_[i]));
    strips[column.name] = std::move(values);
  }
  return strips;
}

}  // namespace earshot::report
