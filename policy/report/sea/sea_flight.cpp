#include "policy/report/sea/sea_flight.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <iomanip>
#include <iterator>
#include <sstream>
#include <variant>

#include "earshot/command_acknowledgement_t.hpp"
#include "earshot/decision_t.hpp"
#include "earshot/health_t.hpp"
#include "earshot/journal_resumed_t.hpp"
#include "earshot/mission_t.hpp"
#include "earshot/safety_event_t.hpp"
#include "firmware/config/safety.hpp"
#include "firmware/host/journal/journal_reader.hpp"
#include "firmware/host/journal/rule_event_words.hpp"
#include "firmware/host/safety_record/words/record_words.hpp"
#include "firmware/messages/command_words.hpp"
#include "firmware/messages/health_words.hpp"
#include "firmware/messages/input.hpp"
#include "firmware/messages/safety_event.hpp"
#include "firmware/wire/journal/input_record.hpp"
#include "firmware/wire/lcm/channels.hpp"
#include "firmware/wire/lcm/conversion.hpp"
#include "firmware/wire/lcm/encoding.hpp"

namespace earshot::report {
namespace {

using messages::CommandOutcome;
using messages::EndReason;
using messages::MissionState;
using messages::Order;

constexpr double kSecondsPerMicrosecond = 1e-6;
/// By which come the vehicle computer's own orders: the ABORT of a program that is told to stop.
constexpr std::uint8_t kEarshotItself = 0;

std::optional<SeaFlight> begun_with(const host::JournalRecord& record) {
  mission_t mission{};
  if (record.channel != wire::kMissionChannel || wire::decode(record.data, mission) != Status::kOk) return std::nullopt;
  SeaFlight flight;
  flight.began_s = static_cast<double>(record.time.us) * kSecondsPerMicrosecond;
  flight.area = {{Meters{mission.south_m}, Meters{mission.west_m}}, {Meters{mission.north_m}, Meters{mission.east_m}}};
  if (!is_finite(flight.area.south_west) || !is_finite(flight.area.north_east)) return std::nullopt;
  flight.threshold = Decibels{mission.detection_threshold_db};
  flight.depth = Meters{mission.search_depth_m};
  flight.speed = MetersPerSecond{mission.search_speed_mps};
  flight.frequency = Hertz{mission.source_frequency_hz};
  flight.account.max_steps = static_cast<std::uint32_t>(mission.max_steps);
  const char* const build = reinterpret_cast<const char*>(mission.build);
  flight.build.assign(build, ::strnlen(build, std::size(mission.build)));
  return flight;
}

void note_account(const health_t& health, search::SearchAccount& account) {
  const auto step = static_cast<std::uint32_t>(health.steps_taken);
  account.surprise_bits = double{health.surprise_bits};
  if (health.surprise_bits >= messages::kSurprising_bits && !account.surprised_step) account.surprised_step = step;
  if (health.sweeping != 0 && !account.sweep_step) account.sweep_step = step;
  if (health.found != 0 && !account.declared_step) account.declared_step = step;
}

void note_health(double time_s, const health_t& health, SeaFlight& flight) {
  const MissionState before = flight.state;
  flight.state = static_cast<MissionState>(health.state);
  flight.end_reason = static_cast<EndReason>(health.end_reason);
  flight.steps_taken = static_cast<std::uint32_t>(health.steps_taken);
  flight.counters.navigation_refused = static_cast<std::uint64_t>(health.navigation_refused);
  flight.counters.snr_refused = static_cast<std::uint64_t>(health.snr_refused);
  flight.counters.bearings_refused = static_cast<std::uint64_t>(health.bearings_refused);
  flight.counters.bearings_of_others = static_cast<std::uint64_t>(health.bearings_of_others);
  flight.counters.commands_refused = static_cast<std::uint64_t>(health.commands_refused);
  if (flight.state == MissionState::kSearch && before != MissionState::kSearch)
    flight.account = {.believes = flight.account.believes, .max_steps = flight.account.max_steps};
  if (flight.state != MissionState::kStandby) note_account(health, flight.account);
  if (flight.state == before) return;
  const std::string reason = flight.end_reason == EndReason::kNone ? "" : std::string(": ") + flight.why_it_ended();
  flight.events.push_back({time_s, messages::to_string(flight.state) + reason});
  if (flight.state == MissionState::kSearch) flight.search_began_s = time_s;
  if (before == MissionState::kSearch) flight.search_ended_s = time_s;
}

void note_answer(double time_s, const command_acknowledgement_t& answer, SeaFlight& flight) {
  std::optional<SeaFlight::Answer>& last = flight.last_answer;
  if (last && last->issuer == answer.issuer && last->number == answer.number && last->outcome == answer.outcome) {
    flight.events.at(last->event).what = last->what + " (" + std::to_string(++last->times) + " times)";
    return;
  }
  const std::string what = std::string("order ") + messages::to_string(static_cast<Order>(answer.command)) + ", " +
                           messages::to_string(static_cast<CommandOutcome>(answer.outcome));
  last = {.issuer = answer.issuer, .number = answer.number, .outcome = answer.outcome, .what = what, .event = flight.events.size()};
  flight.events.push_back({time_s, what});
}

/// @param last_s  of the last record of the process before
std::string words_for_resuming(double last_s, double time_s) {
  std::ostringstream text;
  text << std::fixed << std::setprecision(0) << "earshotd was killed or lost its power; another process goes on from the journal, "
       << std::max(0.0, time_s - last_s) << " s after its last record";
  return text.str();
}

void note_rule(double time_s, const messages::SafetyEvent& event, SeaFlight& flight) {
  const std::string rule = host::to_string(event);
  flight.events.push_back({time_s, rule});
  if (flight.state != MissionState::kSearch || !event.begins) return;
  if (event.response >= config::Response::kAbort)
    flight.ending_rule = rule;
  else if (event.response >= config::Response::kReturn && !flight.account.way_home)
    flight.account.way_home = {.rule = rule, .steps = flight.steps_taken, .is_to_surface = event.response == config::Response::kSurface};
}

void note(const host::JournalRecord& record, SeaFlight& flight) {
  const double time_s = static_cast<double>(record.time.us) * kSecondsPerMicrosecond - flight.began_s;
  const double last_s = flight.ended_s;
  flight.ended_s = std::max(flight.ended_s, time_s);
  messages::Input input;
  health_t health{};
  decision_t decision{};
  command_acknowledgement_t acknowledgement{};
  safety_event_t event{};
  journal_resumed_t resumed{};
  if (wire::read_input(record.channel, record.time, record.data, 0, input) == Status::kOk) {
    if (const auto* fix = std::get_if<messages::Navigation>(&input.value); fix != nullptr && messages::is_usable(*fix))
      flight.fixes.push_back({.time_s = time_s, .position = fix->position, .depth = fix->depth});
    if (const auto* snr = std::get_if<messages::SnrMeasurement>(&input.value); snr != nullptr && std::isfinite(snr->snr.value))
      flight.measurements.push_back({.time_s = time_s, .snr_db = snr->snr.value, .too_faint = snr->too_faint});
    const auto* const order = std::get_if<messages::OperatorCommand>(&input.value);
    const bool is_own_abort = order != nullptr && order->order == Order::kAbort && input.port == kEarshotItself;
    if (is_own_abort && flight.end_reason == EndReason::kNone) flight.is_stopped = true;
  } else if (record.channel == wire::kHealthChannel && wire::decode(record.data, health) == Status::kOk) {
    note_health(time_s, health, flight);
  } else if (record.channel == wire::kDecisionChannel && wire::decode(record.data, decision) == Status::kOk) {
    flight.account.believes = decision.believes != 0;
  } else if (record.channel == wire::kSafetyEventChannel && wire::decode(record.data, event) == Status::kOk) {
    note_rule(time_s, wire::from_message(event), flight);
  } else if (record.channel == wire::kJournalResumedChannel && wire::decode(record.data, resumed) == Status::kOk) {
    flight.events.push_back({time_s, words_for_resuming(last_s, time_s)});
  } else if (record.channel == wire::kAcknowledgementChannel && wire::decode(record.data, acknowledgement) == Status::kOk) {
    note_answer(time_s, acknowledgement, flight);
  }
}

}  // namespace

const char* SeaFlight::why_it_ended() const {
  return is_stopped && end_reason == EndReason::kOperatorAbort ? "its program was stopped" : messages::to_string(end_reason);
}

bool SeaFlight::is_dated() const {
  constexpr double kSecondsToTheYear2000 = 946'684'800.0;  // no simulated flight lasts so long
  return began_s >= kSecondsToTheYear2000;
}

Meters SeaFlight::distance() const {
  Meters sum{0.0};
  const Fix* before = nullptr;
  for (const Fix& fix : fixes) {
    if (!search_began_s || fix.time_s < *search_began_s || (search_ended_s && fix.time_s > *search_ended_s)) continue;
    if (before != nullptr) sum = sum + range_between(before->position, fix.position);
    before = &fix;
  }
  return sum;
}

std::optional<SeaFlight> read_sea_flight(const std::filesystem::path& journal) {
  host::JournalReader reader(journal);
  host::JournalRecord record;
  if (!reader.next(record)) return std::nullopt;
  std::optional<SeaFlight> flight = begun_with(record);
  while (flight && reader.next(record)) note(record, *flight);
  if (flight) flight->safety_record = host::safety_record_beside(journal);
  return flight;
}

std::string utc(double seconds_since_1970) {
  using namespace std::chrono;
  const sys_seconds time{seconds{std::llround(std::floor(seconds_since_1970))}};
  const sys_days day = std::chrono::floor<days>(time);
  const year_month_day date{day};
  const hh_mm_ss clock{time - day};
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), "%04d-%02u-%02u %02d:%02d:%02d UTC", static_cast<int>(date.year()),
                static_cast<unsigned>(date.month()), static_cast<unsigned>(date.day()), static_cast<int>(clock.hours().count()),
                static_cast<int>(clock.minutes().count()), static_cast<int>(clock.seconds().count()));
  return text.data();
}

}  // namespace earshot::report
