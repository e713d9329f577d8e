#include "policy/report/document/growing_flight.hpp"

#include <algorithm>
#include <type_traits>
#include <utility>
#include <vector>

#include "firmware/desk/journal_view/events/timeline.hpp"
#include "firmware/host/safety_record/words/record_words.hpp"
#include "firmware/host/text/numbers.hpp"
#include "firmware/host/text/utc.hpp"
#include "policy/report/document/decision_explainer.hpp"
#include "policy/report/document/decision_value.hpp"
#include "policy/report/document/flight_parts.hpp"
#include "policy/report/document/flight_words.hpp"
#include "policy/report/document/json_values.hpp"
#include "policy/report/document/turn_rows.hpp"

namespace earshot::report {
namespace {

using nlohmann::ordered_json;

constexpr int kFormat = 1;

const char* to_string(journal::Event::Kind kind) {
  static constexpr const char* kNames[] = {"order", "answer", "state", "rule", "link", "decision", "journal", "other"};
  return kNames[static_cast<std::size_t>(kind)];
}

/// "2026-11-22T15:04:07Z"
ordered_json utc_value(Time time) {
  if (!host::is_dated(time)) return nullptr;
  std::string text = host::date_and_time(time);
  std::ranges::replace(text, ' ', 'T');
  return text + "Z";
}

ordered_json rows_from(const std::vector<ordered_json>& rows, std::size_t first) {
  ordered_json array = ordered_json::array();
  for (std::size_t i = first; i < rows.size(); ++i) array.push_back(rows[i]);
  return array;
}

}  // namespace

class GrowingFlight::Parts {
 public:
  explicit Parts(FlightSurroundings surroundings)
      : around_(std::move(surroundings)), explainer_(around_.journal, around_.recording, around_.baseline, around_.files.snr) {}

  void take(const journal::Entry& entry) {
    std::vector<journal::Event> events = timeline_.take(entry);
    journal_.take(entry);
    if (const auto* const record = std::get_if<journal::Record>(&entry)) {
      if (!std::exchange(has_begun_, true)) begin(record->time);
      if (std::holds_alternative<messages::JournalResumed>(record->content) && !events.empty())
        events.back().text += "; " + host::decimals((record->time - last_).to_seconds(), 0) + " s after the last record";
      last_ = record->time;
      by_journal_.take(*record);
      std::visit([&](const auto& content) { note(content, *record); }, record->content);
    }
    add(events);
  }

  void end(const journal::RecordSource& source) {
    add(timeline_.finish(source.torn_end()));
    journal_.end_with(source);
    has_ended_ = true;
    if (!around_.journal.empty()) by_journal_.note_safety_record(host::safety_record_beside(around_.journal));
  }

  [[nodiscard]] ordered_json whole(std::size_t most_rows) {
    ordered_json flight = others();
    flight["strips"] = turns_.strips(0, most_rows);
    flight["decisions"] = decisions_;
    flight["events"] = events_;
    return flight;
  }

  [[nodiscard]] ordered_json changes(Sent& sent) {
    ordered_json changes = ordered_json::object();
    ordered_json now = others();
    for (const auto& [name, value] : now.items()) {
      if (!sent.others.contains(name) || sent.others.at(name) != value) changes[name] = value;
    }
    if (turns_.size() > sent.turns) changes["strips"] = turns_.strips(sent.turns, turns_.size());
    if (decisions_.size() > sent.decisions) changes["decisions"] = rows_from(decisions_, sent.decisions);
    if (events_.size() > sent.events) changes["events"] = rows_from(events_, sent.events);
    sent = {.turns = turns_.size(), .decisions = decisions_.size(), .events = events_.size(), .others = std::move(now)};
    return changes;
  }

  [[nodiscard]] Sent all_sent() const {
    return {.turns = turns_.size(), .decisions = decisions_.size(), .events = events_.size(), .others = others()};
  }

  [[nodiscard]] bool is_over() const {
    return has_ended_ || timeline_.is_closed() || (health_ && health_->end_reason != messages::EndReason::kNone);
  }
  [[nodiscard]] const JournalledSearch& journal() const { return journal_; }
  /// A killed simulator should have left its files; a vehicle has none, nor has a simulator that still flies.
  [[nodiscard]] FlightFiles files() const {
    FlightFiles files{.summary = around_.files.summary, .snr = {}, .sound = {}, .missing = {}};
    if (has_ended_ && !host::is_dated(began_)) files.missing = around_.files.missing;
    return files;
  }

  [[nodiscard]] const std::optional<SeaFlight>& by_journal() const { return by_journal_.flight(); }
  [[nodiscard]] const std::string& unexplained() const {
    static const std::string kNothing;
    return explainer_.is_at_fault() ? explainer_.why_not() : kNothing;
  }

 private:
  void begin(Time time) {
    began_ = last_ = time;
    turns_ = TurnRows(time);
    if (!around_.files.summary.is_null()) explainer_.set_south_west(place_in(around_.files.summary.at("area").at("south_west")));
  }

  [[nodiscard]] double seconds(Time time) const { return (time - began_).to_seconds(); }

  void note(const messages::MissionRecord& record, const journal::Record& /*record*/) {
    mission_ = record.mission;
    turns_.take(record.mission);
    if (is_finite(record.mission.operating_area.south_west)) explainer_.set_south_west(record.mission.operating_area.south_west);
  }
  void note(const journal::PolicyBytes& policy, const journal::Record& /*record*/) { explainer_.take(policy); }
  void note(const journal::TablesBytes& tables, const journal::Record& /*record*/) { explainer_.take(tables); }
  void note(const messages::Input& input, const journal::Record& /*record*/) { turns_.take(input); }
  void note(const messages::Setpoint& setpoint, const journal::Record& /*record*/) { turns_.take(setpoint); }
  void note(const messages::Health& health, const journal::Record& record) {
    health_ = health;
    turns_.take(record.time, health);
  }
  void note(const messages::Decision& decision, const journal::Record& /*record*/) {
    const explain::RecordedDecision& recorded = journal_.decisions.back();
    decisions_.push_back(decision_value(seconds(decision.time), recorded, explainer_.explain(recorded)));
    turns_.expect(explainer_.expectation(), decision.belief.has_value());
  }
  template <class Content>
  void note(const Content& /*content*/, const journal::Record& /*record*/) {}

  void add(const std::vector<journal::Event>& events) {
    for (const journal::Event& event : events)
      events_.push_back({{"time_s", rounded(seconds(event.time), 3)}, {"kind", to_string(event.kind)}, {"text", event.text}});
  }

  /// All but the rows.
  [[nodiscard]] ordered_json others() const {
    const FlightFiles of_simulator = files();
    const FlightSources sources{.files = of_simulator,
                                .journal = journal_,
                                .by_journal = by_journal_.flight(),
                                .unexplained = explainer_.why_not(),
                                .uses_measurements = explainer_.uses_measurements(),
                                .is_being_written = !has_ended_};
    const FlightVerdict verdict = verdict_on(sources);
    ordered_json facts = ordered_json::array();
    for (const Condition& fact : facts_of(sources))
      facts.push_back({{"name", fact.name}, {"value", fact.value}, {"meaning", fact.meaning}});
    return {{"format", kFormat},
            {"name", around_.name},
            {"began_utc", utc_value(began_)},
            {"is_simulated", !of_simulator.summary.is_null() || (has_begun_ && !host::is_dated(began_))},
            {"is_over", is_over()},
            {"verdict", {{"text", verdict.text}, {"found", verdict.is_found ? ordered_json(*verdict.is_found) : ordered_json()}}},
            {"sentences", sentences_on(sources)},
            {"shortcomings", shortcomings_of(sources)},
            {"facts", facts},
            {"mission", mission_ ? mission_value(*mission_, of_simulator.summary) : ordered_json()},
            {"health", health_ ? health_value(*health_) : ordered_json()},
            {"sound", sound_value(around_.files.sound, seconds_of_clock())},
            {"truth", truth_value(around_.files)},
            {"open_at_step", around_.open_at_step ? ordered_json(*around_.open_at_step) : ordered_json()}};
  }

  [[nodiscard]] double seconds_of_clock() const { return static_cast<double>(began_.us) * 1e-6; }

  FlightSurroundings around_;
  journal::Timeline timeline_;
  JournalledSearch journal_;
  SeaFlightReader by_journal_;
  DecisionExplainer explainer_;
  TurnRows turns_;
  std::optional<config::Mission> mission_;
  std::optional<messages::Health> health_;
  std::vector<ordered_json> decisions_;
  std::vector<ordered_json> events_;
  Time began_;
  Time last_;  ///< of the records
  bool has_begun_ = false;
  bool has_ended_ = false;
};

GrowingFlight::GrowingFlight(FlightSurroundings surroundings) : parts_(std::make_unique<Parts>(std::move(surroundings))) {}
GrowingFlight::~GrowingFlight() = default;

void GrowingFlight::take(const journal::Entry& entry) {
  parts_->take(entry);
}
void GrowingFlight::end(const journal::RecordSource& source) {
  parts_->end(source);
}
ordered_json GrowingFlight::whole(std::size_t most_rows) {
  return parts_->whole(most_rows);
}
ordered_json GrowingFlight::changes(Sent& sent) {
  return parts_->changes(sent);
}
Sent GrowingFlight::all_sent() {
  return parts_->all_sent();
}
bool GrowingFlight::is_over() const {
  return parts_->is_over();
}
const JournalledSearch& GrowingFlight::journal() const {
  return parts_->journal();
}
FlightFiles GrowingFlight::files() const {
  return parts_->files();
}
const std::optional<SeaFlight>& GrowingFlight::by_journal() const {
  return parts_->by_journal();
}
const std::string& GrowingFlight::unexplained() const {
  return parts_->unexplained();
}

}  // namespace earshot::report
