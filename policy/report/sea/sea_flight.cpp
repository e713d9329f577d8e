#include "policy/report/sea/sea_flight.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <variant>

#include "firmware/config/safety.hpp"
#include "firmware/host/journal/reading/record_source.hpp"
#include "firmware/host/journal/words/rule_event_words.hpp"
#include "firmware/host/safety_record/words/record_words.hpp"
#include "firmware/host/text/utc.hpp"
#include "firmware/messages/input.hpp"
#include "firmware/messages/safety_event.hpp"

namespace earshot::report {
namespace {

using messages::EndReason;
using messages::MissionState;

/// By which come the vehicle computer's own orders: the ABORT of a program that is stopped.
constexpr std::uint8_t kEarshotItself = 0;

std::optional<SeaFlight> begun_with(const journal::Record& first) {
  const auto* const record = std::get_if<messages::MissionRecord>(&first.content);
  if (record == nullptr) return std::nullopt;
  SeaFlight flight;
  flight.began = first.time;
  flight.area = record->mission.operating_area;
  if (!is_finite(flight.area.south_west) || !is_finite(flight.area.north_east)) return std::nullopt;
  const config::Mission& mission = record->mission;
  flight.threshold = mission.detection_threshold;
  flight.depth = mission.search_depth;
  flight.speed = mission.search_speed;
  flight.frequency = mission.source_frequency;
  flight.account.max_steps = mission.max_steps;
  flight.build = messages::text_of(record->build);
  return flight;
}

void note_account(const messages::Health& health, search::SearchAccount& account) {
  const std::uint32_t step = health.steps_taken;
  account.mismatch_bits = double{health.mismatch_bits};
  if (health.mismatch_bits >= messages::kMismatchThreshold_bits && !account.mismatch_step) account.mismatch_step = step;
  if (health.is_sweeping && !account.sweep_step) account.sweep_step = step;
  if (health.is_found && !account.declared_step) account.declared_step = step;
}

}  // namespace

const char* SeaFlight::why_it_ended() const {
  return journal::why_it_ended(end_reason, aborted_by);
}

bool SeaFlight::is_dated() const {
  return host::is_dated(began);
}

void SeaFlightReader::take(const journal::Record& record) {
  if (!std::exchange(has_begun_, true)) flight_ = begun_with(record);
  if (!flight_) return;
  time_s_ = (record.time - flight_->began).to_seconds();
  flight_->ended_s = std::max(flight_->ended_s, time_s_);
  std::visit([this](const auto& content) { note(content); }, record.content);
}

void SeaFlightReader::note_safety_record(std::optional<std::string> words) {
  if (flight_) flight_->safety_record = std::move(words);
}

void SeaFlightReader::note(const messages::Input& input) {
  if (const auto* fix = std::get_if<messages::Navigation>(&input.value); fix != nullptr && messages::is_usable(*fix)) {
    ++flight_->fixes;
    if (flight_->state == MissionState::kSearch) {
      if (place_) flight_->sailed += range_between(*place_, fix->position);
      place_ = fix->position;
    }
  }
  if (const auto* snr = std::get_if<messages::SnrMeasurement>(&input.value); snr != nullptr && std::isfinite(snr->snr.value)) {
    ++flight_->measurements;
    if (!snr->too_faint) flight_->loudest_db = std::max(flight_->loudest_db.value_or(snr->snr.value), snr->snr.value);
  }
  const auto* const order = std::get_if<messages::OperatorCommand>(&input.value);
  const bool is_own_abort = order != nullptr && order->order == messages::Order::kAbort && input.port == kEarshotItself;
  if (is_own_abort && flight_->end_reason == EndReason::kNone) flight_->aborted_by = journal::AbortedBy::kProgram;
}

void SeaFlightReader::note(const messages::Health& health) {
  const MissionState before = flight_->state;
  flight_->state = health.state;
  flight_->end_reason = health.end_reason;
  flight_->steps_taken = health.steps_taken;
  flight_->counters = health.counters;
  const bool is_new_search = health.state == MissionState::kSearch && before != MissionState::kSearch;
  if (is_new_search) flight_->account = {.believes = flight_->account.believes, .max_steps = flight_->account.max_steps};
  if (health.state != MissionState::kStandby) note_account(health, flight_->account);
  if (health.state == before) return;
  place_ = std::nullopt;
  if (is_new_search) flight_->search_began_s = time_s_;
  if (before == MissionState::kSearch) flight_->search_ended_s = time_s_;
}

void SeaFlightReader::note(const messages::SafetyEvent& event) {
  if (flight_->state != MissionState::kSearch || !event.begins) return;
  const std::string rule = journal::to_string(event);
  if (event.response >= config::Response::kAbort)
    flight_->ending_rule = rule;
  else if (event.response >= config::Response::kReturn && !flight_->account.way_home)
    flight_->account.way_home = {
        .rule = rule, .steps = flight_->steps_taken, .is_to_surface = event.response == config::Response::kSurface};
}

void SeaFlightReader::note(const messages::Decision& decision) {
  flight_->account.believes = decision.belief.has_value();
}

std::optional<SeaFlight> read_sea_flight(const std::filesystem::path& journal) {
  SeaFlightReader reader;
  journal::for_each_record(journal, [&reader](const journal::Record& record) { reader.take(record); });
  reader.note_safety_record(host::safety_record_beside(journal));
  return reader.flight();
}

}  // namespace earshot::report
