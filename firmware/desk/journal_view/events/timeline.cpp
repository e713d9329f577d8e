#include "firmware/desk/journal_view/events/timeline.hpp"

#include <algorithm>
#include <type_traits>
#include <utility>
#include <variant>

#include "firmware/config/safety.hpp"
#include "firmware/host/file/checksum_text.hpp"
#include "firmware/host/file/printable.hpp"
#include "firmware/host/journal/words/event_words.hpp"
#include "firmware/host/journal/words/rule_event_words.hpp"
#include "firmware/host/journal/words/wording.hpp"
#include "firmware/host/text/numbers.hpp"
#include "firmware/host/text/text_line.hpp"
#include "firmware/host/text/utc.hpp"
#include "firmware/messages/dictionary/health_words.hpp"

namespace earshot::journal {

using Severity = Event::Severity;

namespace {

/// What the events of a record, or of an input, are about.
template <class Content>
constexpr Event::Kind kKindOf = Event::Kind::kOther;
template <>
constexpr Event::Kind kKindOf<messages::OperatorCommand> = Event::Kind::kOrder;
template <>
constexpr Event::Kind kKindOf<messages::CommandAcknowledgement> = Event::Kind::kAnswer;
template <>
constexpr Event::Kind kKindOf<messages::Health> = Event::Kind::kState;
template <>
constexpr Event::Kind kKindOf<messages::SafetyEvent> = Event::Kind::kRule;
template <>
constexpr Event::Kind kKindOf<messages::PortReport> = Event::Kind::kLink;
template <>
constexpr Event::Kind kKindOf<messages::UnsentSetpoints> = Event::Kind::kLink;
template <>
constexpr Event::Kind kKindOf<messages::ControllerTrouble> = Event::Kind::kLink;
template <>
constexpr Event::Kind kKindOf<messages::Decision> = Event::Kind::kDecision;
template <>
constexpr Event::Kind kKindOf<messages::MissionRecord> = Event::Kind::kJournal;
template <>
constexpr Event::Kind kKindOf<PolicyBytes> = Event::Kind::kJournal;
template <>
constexpr Event::Kind kKindOf<TablesBytes> = Event::Kind::kJournal;
template <>
constexpr Event::Kind kKindOf<messages::ClosingRecord> = Event::Kind::kJournal;
template <>
constexpr Event::Kind kKindOf<messages::JournalResumed> = Event::Kind::kJournal;

/// What `write` writes into a line.
std::string line_of(const auto& write) {
  host::TextLine line;
  write(line);
  return std::string(line.text());
}

}  // namespace

bool Timeline::Grown::has_grown(std::uint64_t now) {
  const bool grows = now > seen;
  seen = now;
  return grows && !std::exchange(is_reported, is_reported || grows);
}

std::string to_line(const Event& event, Time began) {
  constexpr std::size_t kSecondsWidth = 9;  // a day has 86400.0
  std::string seconds = host::decimals((event.time - began).to_seconds(), 1);
  seconds.insert(0, seconds.size() < kSecondsWidth ? kSecondsWidth - seconds.size() : 0, ' ');
  return (host::is_dated(event.time) ? utc(event.time) + " " : "") + seconds + " s  " + event.text;
}

std::vector<Event> Timeline::take(const Entry& entry) {
  events_.clear();
  std::visit([this](const auto& value) { note(value); }, entry);
  return std::move(events_);
}

std::vector<Event> Timeline::finish(const std::optional<TornEnd>& torn) {
  events_.clear();
  add_repetitions();
  if (torn) add_lack(to_string(*torn));
  if (!is_closed_ && !is_bus_log_)
    add_lack("the journal's end is missing: its program was killed, lost its power, met an error, or still writes (--follow waits for it)");
  return std::move(events_);
}

void Timeline::add_order(Severity severity, std::string text) {
  const auto known = std::ranges::find(orders_, text, &Order::text);
  if (known != orders_.end()) {
    ++known->times;
    return;
  }
  add(severity, text);
  if (orders_.size() == kRememberedOrders) orders_.pop_front();
  orders_.push_back({.severity = severity, .kind = kind_, .text = std::move(text)});
}

void Timeline::add_repetitions() {
  for (Order& order : orders_) {
    if (order.times == order.reported_times) continue;
    order.reported_times = order.times;
    events_.push_back({.severity = order.severity,
                       .time = now_,
                       .text = order.text + " (" + host::counted(order.times, "time") + ")",
                       .kind = order.kind});
  }
}

void Timeline::add(Severity severity, std::string text, bool is_lack) {
  add_repetitions();
  events_.push_back(
      {.severity = severity, .time = now_, .text = std::move(text), .kind = is_lack ? Event::Kind::kJournal : kind_, .is_lack = is_lack});
}

void Timeline::add_lack(std::string text) {
  add(Severity::kError, std::move(text), true);
}

void Timeline::note(const Record& record) {
  if (!began_) began_ = record.time;
  now_ = record.time;
  std::visit(
      [&](const auto& content) {
        kind_ = kKindOf<std::remove_cvref_t<decltype(content)>>;
        note_content(content, record);
      },
      record.content);
}

void Timeline::note(const MissingRecords& missing) {
  add_lack(to_string(missing));
}

void Timeline::note(const DamagedBytes& damage) {
  add_lack(to_string(damage));
}

void Timeline::note(const NumbersGoBack& numbers) {
  add_lack(to_string(numbers));
}

void Timeline::note(const BusLog& /*log*/) {
  is_bus_log_ = true;
  add_lack(
      "no mission record, no checksums: this is no journal of Earshot, but a log of a bus (lcm-logger); what was not on that bus is not "
      "in it, and nobody would notice if a byte of it were another");
}

void Timeline::note_content(const Unreadable& unreadable, const Record& record) {
  if (is_bus_log_ && !unreadable.is_known_channel) return;  // others', and sound: a bus is for everybody
  if (!unreadable_.has_grown(unreadable_.seen + 1)) return;
  add_lack("record " + std::to_string(record.number) + " on " + host::printable(record.channel) + " cannot be read: " +
           (unreadable.is_known_channel ? "its message is of another version of Earshot" : "this program knows no such channel") +
           "; of more like it nothing is printed");
}

void Timeline::note_content(const messages::MissionRecord& mission, const Record& /*record*/) {
  policy_crc32_ = mission.policy_crc32;
  tables_crc32_ = mission.tables_crc32;
  inform(to_string(mission));
}

void Timeline::note_content(const PolicyBytes& policy, const Record& /*record*/) {
  note_bytes("policy: " + host::counted(policy.bytes.size(), "byte"), policy.crc32, policy_crc32_);
}

void Timeline::note_content(const TablesBytes& tables, const Record& /*record*/) {
  if (tables.bytes.empty() && tables.crc32 == tables_crc32_.value_or(0)) return;  // the policy needs none
  note_bytes("ocean tables: " + host::counted(tables.bytes.size(), "byte"), tables.crc32, tables_crc32_);
}

/// @param named  by the mission
void Timeline::note_bytes(const std::string& text, std::uint32_t crc32, std::optional<std::uint32_t> named) {
  const std::string described = text + ", CRC-32 " + host::crc32_text(crc32);
  if (named && *named != crc32)
    add_lack(described + ", which is not the " + host::crc32_text(*named) + " that its mission names");
  else
    inform(described);
}

void Timeline::note_content(const messages::Input& input, const Record& /*record*/) {
  std::visit(
      [&](const auto& value) {
        kind_ = kKindOf<std::remove_cvref_t<decltype(value)>>;
        note_input(value, input.port);
      },
      input.value);
}

void Timeline::note_content(const messages::Setpoint& setpoint, const Record& /*record*/) {
  if (releases_weight_.changes_to(setpoint.release_weight) && setpoint.release_weight) warn("the drop weight is asked to be released");
}

void Timeline::note_content(const messages::Decision& decision, const Record& /*record*/) {
  inform(to_string(decision));
}

void Timeline::note_content(const messages::SafetyEvent& event, const Record& /*record*/) {
  const bool ends_it = event.response >= config::Response::kAbort;
  add(!event.begins ? Severity::kInformation : ends_it ? Severity::kError : Severity::kWarning, to_string(event));
}

void Timeline::note_content(const messages::CommandAcknowledgement& acknowledgement, const Record& /*record*/) {
  const messages::CommandOutcome outcome = acknowledgement.outcome;
  const bool is_good = messages::was_obeyed(outcome) || outcome == messages::CommandOutcome::kRepeated;
  add_order(is_good ? Severity::kInformation : Severity::kWarning, to_string(acknowledgement));
}

void Timeline::note_content(const messages::Health& health, const Record& /*record*/) {
  if (mission_state_.changes_to(health.state)) {
    for (Grown* counter : {&navigation_refused_, &snr_refused_, &status_refused_, &bearings_refused_, &bearings_of_others_})
      counter->is_reported = false;
    for (Port& port : ports_) port.failures.is_reported = false;
    if (health.state == messages::MissionState::kSearch) is_mismatch_reported_ = false;
  }
  const bool is_abort = health.state == messages::MissionState::kAbort;
  const bool is_mismatched = health.mismatch_bits >= messages::kMismatchThreshold_bits;
  if (const std::string state = to_string(health, is_mismatch_reported_ || is_mismatched, aborted_by_); state_.changes_to(state))
    add(is_abort ? Severity::kWarning : Severity::kInformation, state);
  if (is_mismatched && !std::exchange(is_mismatch_reported_, true))
    warn(std::string(messages::kIsMismatched) + " (model-mismatch score " + host::decimals(double{health.mismatch_bits}, 1) + " bits)");
  is_over_ = health.end_reason != messages::EndReason::kNone;
  note_refused(health);
}

void Timeline::note_refused(const messages::Health& health) {
  const auto add_growth = [this](Grown& counter, std::uint64_t count, const char* what) {
    if (counter.has_grown(count)) warn(line_of([&](host::TextInto& line) { write_refused(line, what, counter.seen); }));
  };
  add_growth(navigation_refused_, health.counters.navigation_refused, "navigation");
  add_growth(snr_refused_, health.counters.snr_refused, "SNR");
  add_growth(status_refused_, health.counters.status_refused, "status");
  add_growth(bearings_refused_, health.counters.bearings_refused, "bearing");
  if (bearings_of_others_.has_grown(health.counters.bearings_of_others))
    warn(line_of([this](host::TextInto& line) { write_bearings_of_others(line, bearings_of_others_.seen); }));
}

void Timeline::note_content(const messages::ClosingRecord& closing, const Record& /*record*/) {
  is_closed_ = true;
  if (closing.lost.all() > 0)
    add_lack(to_string(closing, aborted_by_));
  else
    inform(to_string(closing, aborted_by_));
}

void Timeline::note_content(const messages::JournalResumed& resumed, const Record& /*record*/) {
  warn(to_string(resumed));
}

void Timeline::note_content(const messages::ControllerTrouble& trouble, const Record& /*record*/) {
  add(trouble.is_there ? Severity::kWarning : Severity::kInformation, to_string(trouble));
}

void Timeline::note_content(const messages::SoundDetection& detection, const Record& /*record*/) {
  inform(line_of([&](host::TextInto& line) { write_detection(line, detection, utc(detection.begin)); }));
}

void Timeline::note_content(const messages::PublishedChallenge& /*challenge*/, const Record& /*record*/) {}  // every turn, and the same

void Timeline::note_input(const messages::PortReport& report, std::uint8_t /*port*/) {
  if (report.port >= ports_.size()) return;
  Port& port = ports_.at(report.port);
  const std::string name = report.port == 0 ? "journal: " : "port " + std::to_string(report.port) + ": ";
  if (port.is_down.changes_to(!report.link_up))
    add(report.link_up ? Severity::kInformation : Severity::kWarning,
        name + std::string(report.port == 0 ? words_of_disk(report.link_up) : words_of_link(report.link_up)));
  if (port.failures.has_grown(report.lost + report.malformed + report.unsent))
    warn(name + "so far " + std::to_string(report.lost) + " lost, " + std::to_string(report.malformed) + " malformed and " +
         std::to_string(report.unsent) + " not sent");
}

void Timeline::note_input(const messages::UnsentSetpoints& unsent, std::uint8_t /*port*/) {
  if (unsent_setpoints_.has_grown(unsent.count)) warn("so far " + host::counted(unsent.count, "set-point") + " could not be sent");
}

void Timeline::note_input(const messages::VehicleStatus& status, std::uint8_t /*port*/) {
  if (has_leak_.changes_to(status.has_leak)) warn(status.has_leak ? "water in the hull" : "no more water in the hull");
  if (has_ground_fault_.changes_to(status.has_ground_fault)) warn(status.has_ground_fault ? "a ground fault" : "no more ground fault");
}

void Timeline::note_input(const messages::AutopilotStatus& status, std::uint8_t /*port*/) {
  if (follows_.changes_to(status.follows_setpoints))
    inform(status.follows_setpoints ? "the autopilot follows set-points" : "the autopilot follows no set-points");
}

void Timeline::note_input(const messages::HydrophoneStatus& status, std::uint8_t /*port*/) {
  if (is_deaf_.changes_to(status.is_deaf)) warn(status.is_deaf ? "the hydrophone is deaf" : "the hydrophone hears again");
}

void Timeline::note_input(const messages::OperatorCommand& command, std::uint8_t port) {
  // By port 0 come the program's own: also what its safety record held, given again after an outage.
  if (port == 0 && command.order == messages::Order::kAbort && !is_over_) aborted_by_ = AbortedBy::kProgram;
  add_order(Severity::kInformation, to_string(command, port));
}

}  // namespace earshot::journal
