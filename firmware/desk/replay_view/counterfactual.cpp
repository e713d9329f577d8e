#include "firmware/desk/replay_view/counterfactual.hpp"

#include <utility>
#include <variant>

#include "firmware/boards/linux/replay/beginning.hpp"
#include "firmware/boards/linux/replay/playback.hpp"
#include "firmware/config/safety.hpp"
#include "firmware/desk/replay_view/thinned_track.hpp"
#include "firmware/host/file/bad_input.hpp"
#include "firmware/host/journal/journal_reader.hpp"
#include "firmware/host/journal/reading/decode_record.hpp"
#include "firmware/runtime/runtime.hpp"
#include "firmware/wire/lcm/channels.hpp"
#include "firmware/wire/lcm/encoding.hpp"

namespace earshot::replay_view {
namespace {

void note(const messages::Health& health, Time time, Standing& standing) {
  const bool is_new = standing.health.turn == 0 || health.state != standing.health.state || health.end_reason != standing.health.end_reason;
  if (is_new) standing.since = time;
  standing.health = health;
}

void note(const messages::SafetyEvent& event, Standing& standing) {
  if (!standing.rule && event.begins && event.response >= config::Response::kAbort) standing.rule = event;
}

class Flight {
 public:
  explicit Flight(const Plan& plan) {
    if (runtime_->configure(plan.mission, *plan.policy, *plan.tables) != Status::kOk)
      throw host::BadInput("the mission cannot be flown with the policy and its ocean tables");
  }

  void take(const host::JournalRecord& record) {
    journal::Content content = journal::decode_record(record.channel, record.time, record.data);
    if (auto* const input = std::get_if<messages::Input>(&content)) {
      input->sequence = inputs_++;
      if (const auto* fix = std::get_if<messages::Navigation>(&input->value)) fix_ = fix->position;
      runtime_->take(*input);
    } else if (record.channel == wire::kJournalledSetpointChannel) {
      setpoint_ = record.data;
    } else if (const auto* const decision = std::get_if<messages::Decision>(&content)) {
      result_.then.push_back(*decision);
    } else if (const auto* const event = std::get_if<messages::SafetyEvent>(&content)) {
      note(*event, result_.then_ended);
    } else if (record.channel == wire::kHealthChannel) {
      end_turn(std::get_if<messages::Health>(&content), record.time);
    }
  }

  [[nodiscard]] Counterfactual result(std::optional<std::uint32_t> gap) && {
    result_.track = track_.places();
    result_.gap = gap;
    return std::move(result_);
  }

 private:
  /// Its health ends every turn. @param then  null: it cannot be read
  void end_turn(const messages::Health* then, Time time) {
    const runtime::Outputs outputs = runtime_->step(time);
    if (then != nullptr) note(*then, time, result_.then_ended);
    note(outputs.health, time, result_.now_ended);
    for (const messages::SafetyEvent& event : outputs.safety_events) note(event, result_.now_ended);
    if (outputs.decision) result_.now.push_back(*outputs.decision);
    compare_steering(outputs, time);
    const bool is_believed = outputs.health.counters.navigation_refused == refused_;
    if (fix_ && is_believed) track_.add(*fix_);
    refused_ = outputs.health.counters.navigation_refused;
    fix_.reset();
    setpoint_.reset();
  }

  void compare_steering(const runtime::Outputs& outputs, Time time) {
    if (result_.steering) return;
    if (outputs.setpoint.has_value() != setpoint_.has_value()) {
      const auto words = [](bool is_steered) { return is_steered ? "given" : "not given"; };
      result_.steering = {
          .time = time,
          .fields = {{.field = "a set-point", .then = words(setpoint_.has_value()), .now = words(outputs.setpoint.has_value())}}};
    } else if (setpoint_) {
      std::vector<FieldDifference> fields =
          field_differences(wire::kJournalledSetpointChannel, *setpoint_, wire::Encoded(*outputs.setpoint, time).bytes());
      if (!fields.empty()) result_.steering = {.time = time, .fields = std::move(fields)};
    }
    if (!result_.steering) return;
    for (const messages::SafetyEvent& event : outputs.safety_events)
      if (event.begins && event.response > config::Response::kWarn) result_.steering->rules.push_back(event);
  }

  std::unique_ptr<runtime::Runtime> runtime_ = std::make_unique<runtime::Runtime>();
  Counterfactual result_;
  ThinnedTrack track_;
  std::optional<NorthEast> fix_;                       ///< the newest of this turn
  std::optional<std::vector<std::uint8_t>> setpoint_;  ///< of this turn, in the journal
  std::uint64_t refused_ = 0;                          ///< fixes, so far
  std::uint64_t inputs_ = 0;
};

}  // namespace

Plan plan_of(const std::filesystem::path& journal) {
  host::JournalReader reader(journal);
  board::Beginning beginning = board::read_beginning(reader, journal);
  return {.mission = beginning.flown.mission, .policy = std::move(beginning.policy), .tables = std::move(beginning.tables)};
}

Counterfactual fly_again(const std::filesystem::path& journal, const Plan& plan, const std::function<void(double fraction)>& progress) {
  constexpr std::uint32_t kBetweenUpdates = 4096;
  host::JournalReader reader(journal);
  Flight flight(plan);
  std::optional<std::uint32_t> gap;
  std::optional<Time> began;
  std::uint32_t number = 0;
  for (host::JournalRecord record; reader.next(record); ++number) {
    if (!began) began = record.time;
    if (record.number != number) {
      gap = number;
      break;
    }
    board::require_possible_date(journal, record);
    flight.take(record);
    if (progress && number % kBetweenUpdates == 0)
      progress(static_cast<double>(reader.offset()) / static_cast<double>(reader.file_size() + 1));
  }
  Counterfactual result = std::move(flight).result(gap);
  result.began = began.value_or(Time{});
  return result;
}

}  // namespace earshot::replay_view
