#include "firmware/boards/linux/mission_turn.hpp"

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <iterator>
#include <optional>
#include <variant>

#include "firmware/boards/linux/turn/turn_records.hpp"
#include "firmware/core/crc32.hpp"
#include "firmware/core/math.hpp"
#include "firmware/wire/journal/input_record.hpp"
#include "firmware/wire/lcm/channels.hpp"
#include "firmware/wire/lcm/encoding.hpp"

namespace earshot::board {
namespace {

using host::Priority;

/// A report of the journal itself outlives the streams on the full disk that it is about; it claims nothing of the orders' reserve, for
/// which streams that still wait would be given up.
/// Nor does an order that was refused: whoever floods the bus with them must not be able to push out those that are obeyed.
Priority priority_of(std::uint8_t port, const InputSink::Value& value, messages::CommandOutcome outcome) {
  if (std::holds_alternative<messages::OperatorCommand>(value)) return messages::was_obeyed(outcome) ? Priority::kOrder : Priority::kStream;
  return port == kOwnPort ? Priority::kSteering : Priority::kStream;
}

/// An order that was not acknowledged comes again.
messages::CommandOutcome outcome_of(const messages::Input& input, const runtime::Acknowledgements* acknowledgements) {
  const auto* const order = std::get_if<messages::OperatorCommand>(&input.value);
  if (order == nullptr || acknowledgements == nullptr) return messages::CommandOutcome::kObeyed;
  const auto known = std::ranges::find_if(*acknowledgements, [&](const messages::CommandAcknowledgement& acknowledgement) {
    return acknowledgement.port == input.port && acknowledgement.issuer == order->issuer && acknowledgement.number == order->number &&
           acknowledgement.order == order->order;
  });
  return known == acknowledgements->end() ? messages::CommandOutcome::kRepeated : known->outcome;
}

bool calls_for_turn(const InputSink::Value& value) {
  return std::holds_alternative<messages::Navigation>(value) || std::holds_alternative<messages::OperatorCommand>(value);
}

/// A disk that comes and goes is told of twice in this time at most: that it went, always at once, and that it came back.
constexpr Duration kJournalDownAtLeast = Duration::seconds(60);

/// With a disk that is asleep, for a record from before Earshot steers: nobody goes by its set-points yet.
constexpr std::chrono::milliseconds kPatienceBeforeSteering{1000};

messages::Build bytes_of(std::string_view build) {
  messages::Build bytes{};
  std::copy_n(build.begin(), std::min(build.size(), bytes.size()), bytes.begin());
  return bytes;
}

}  // namespace

void MissionTurn::append(Time time, std::string_view channel, std::span<const std::uint8_t> data, Priority priority) {
  if (journal_ != nullptr) (void)journal_->append(time, channel, data, priority);  // the journal counts what it loses
}

std::uint32_t MissionTurn::record_mission(const config::Mission& mission, const FlownWith& with) {
  const Time begin = memory_.last = clock_.now();
  const wire::Encoded encoded(
      messages::MissionRecord{
          .mission = mission, .policy_crc32 = crc32(with.policy), .tables_crc32 = crc32(with.tables), .build = bytes_of(with.build)},
      begin);
  append(begin, wire::kMissionChannel, encoded.bytes(), Priority::kOrder);
  append(begin, wire::kPolicyChannel, with.policy, Priority::kOrder);
  append(begin, wire::kTablesChannel, with.tables, Priority::kOrder);
  return host::checksum_of_record(0, begin, wire::kMissionChannel, encoded.bytes());
}

void MissionTurn::report_to(EventLog& event_log) {
  event_log_ = &event_log;
  event_log.log(Time{}, core_.mission());
}

Time MissionTurn::now() {
  return memory_.last = std::max(memory_.last, clock_.now());
}

void MissionTurn::take(std::uint8_t port, const Value& value) {
  const auto* const order = std::get_if<messages::OperatorCommand>(&value);
  const bool is_aborted = outputs_.health.state == messages::MissionState::kAbort;
  if (order != nullptr && port != kOwnPort && !gate_.lets_through(*order, now(), is_aborted)) return ports_.count_lost(port);
  const messages::Input input{.arrival = now(), .port = port, .sequence = memory_.inputs, .value = value};
  memory_.note(input);
  const auto* const fix = std::get_if<messages::Navigation>(&value);
  if (safety_ != nullptr && fix != nullptr && messages::is_usable(*fix)) safety_->hear(*fix);
  if (const std::optional<messages::CommandOutcome> outcome = core_.take(input)) {
    append(input, *outcome);
  } else if (held_.push_back(input) != Status::kOk) {
    append_held(nullptr);
    append(input, messages::CommandOutcome::kObeyed);
  }
  is_called_ = is_called_ || calls_for_turn(value);
}

void MissionTurn::append(const messages::Input& input, messages::CommandOutcome outcome) {
  const wire::InputRecord record(input);
  append(input.arrival, record.channel(), record.data(), priority_of(input.port, input.value, outcome));
}

void MissionTurn::append_held(const runtime::Acknowledgements* acknowledgements) {
  for (const messages::Input& input : held_) append(input, outcome_of(input, acknowledgements));
  held_.clear();
}

void MissionTurn::note_program_stop() {
  if (event_log_ != nullptr) event_log_->note_program_stop();
  if (manager_ != nullptr) manager_->note_stop();
}

void MissionTurn::report_detection(std::uint8_t port, const messages::SoundDetection& detection) {
  ports_.publish_detection(detection);
  if (event_log_ != nullptr) event_log_->log(now(), port, detection);
}

void MissionTurn::report_chain(std::uint8_t port, const HeardChain& chain) {
  if (event_log_ != nullptr) event_log_->log(port, chain);
}

void MissionTurn::report_trouble(std::uint8_t port, BusTrouble trouble, bool is_there) {
  record_trouble(port, trouble, is_there);
  if (event_log_ != nullptr) event_log_->log(port, trouble, is_there);
}

void MissionTurn::report_order_trouble(std::uint8_t port, OrderTrouble trouble) {
  if (event_log_ != nullptr) event_log_->log(port, trouble);
}

/// Of the controller alone: that is what the kernel says. The rest goes by how long something is missing on the host's clock, by which a
/// flight in lock-step would not give the same journal twice.
void MissionTurn::record_trouble(std::uint8_t port, BusTrouble trouble, bool is_there) {
  if (trouble != BusTrouble::kErrorPassive && trouble != BusTrouble::kBusOff) return;
  using messages::ControllerState;
  const messages::ControllerTrouble record{
      .time = now(),
      .port = port,
      .trouble = trouble == BusTrouble::kBusOff ? ControllerState::kBusOff : ControllerState::kErrorPassive,
      .is_there = is_there};
  append(memory_.last, wire::kControllerTroubleChannel, wire::Encoded(record).bytes(), Priority::kSteering);
}

void MissionTurn::go_on_after(const Resumption& before, std::string_view build) {
  memory_ = before.memory;
  outputs_ = before.last;
  for (const Playback::Unwritten& record : before.unwritten) append(memory_.last, record.channel, record.message.bytes(), record.priority);
  const messages::JournalResumed resumed{.time = now(), .cut_bytes = before.cut_bytes, .build = bytes_of(build)};
  append(memory_.last, wire::kJournalResumedChannel, wire::Encoded(resumed).bytes(), Priority::kOrder);
}

runtime::Outputs MissionTurn::operator()() {
  ports_.report_changes(*this);
  const Time turn = now();
  report_journal(turn);
  report_mute();
  is_called_ = false;
  if (is_part_asked_for_ != nullptr && is_part_asked_for_->exchange(false) && journal_ != nullptr) journal_->begin_part();
  outputs_ = core_.step(turn);
  append_held(&outputs_.acknowledgements);
  const bool is_new_state = record(turn, outputs_);
  memory_.note(turn, outputs_);
  write_ahead_of(outputs_, is_new_state);
  const bool is_durable = safety_ == nullptr || safety_->note(turn, outputs_, core_.mission(), patience_with_record());
  ports_.note_speed(is_finite(memory_.speed.value) ? memory_.speed : memory_.commanded_speed);
  if (is_overtaken()) return outputs_;
  const std::uint64_t sent = ports_.setpoints_sent();
  ports_.publish(turn, as_published(is_durable));
  is_mute_ = outputs_.setpoint && ports_.carries_setpoints() && ports_.setpoints_sent() == sent;
  if (manager_ != nullptr) manager_->note_turn(outputs_.health);
  if (event_log_ == nullptr) return outputs_;
  event_log_->log(turn, core_.mission());
  event_log_->report_durable(turn, is_durable);
  for (const messages::SafetyEvent& event : outputs_.safety_events) event_log_->log(event);
  event_log_->log(turn, outputs_.health);
  return outputs_;
}

std::chrono::milliseconds MissionTurn::patience_with_record() const {
  return safety_->record().is_engaged ? patience_ : std::max(patience_, kPatienceBeforeSteering);
}

void MissionTurn::end() {
  append_held(nullptr);
}

runtime::Outputs MissionTurn::send_again() {
  ports_.publish(memory_.last, outputs_);
  return outputs_;
}

void MissionTurn::write_ahead_of(const runtime::Outputs& outputs, bool is_new_state) {
  const bool has_obeyed = std::ranges::any_of(outputs.acknowledgements, [](const messages::CommandAcknowledgement& acknowledgement) {
    return acknowledgement.outcome == messages::CommandOutcome::kObeyed;
  });
  using Reach = host::Journal::Reach;
  if (journal_ == nullptr) return;
  const bool is_urgent = has_obeyed || (is_ahead_always_ && (is_new_state || !outputs.safety_events.empty()));
  if (is_urgent || is_ahead_always_) (void)journal_->flush(patience_, is_urgent ? Reach::kDisk : Reach::kFile);
}

void MissionTurn::report_journal(Time now) {
  const bool is_kept = journal_ == nullptr || journal_->trouble() == host::JournalTrouble::kNone;
  const bool is_fine = is_kept && (safety_ == nullptr || safety_->is_durable());
  if (is_fine == memory_.reports[kOwnPort].link_up || (is_fine && now < journal_up_due_)) return;
  const host::JournalCounters counters = journal_ == nullptr ? host::JournalCounters{} : journal_->counters();
  journal_up_due_ = now + kJournalDownAtLeast;
  take(kOwnPort, messages::PortReport{.port = kOwnPort, .link_up = is_fine, .lost = counters.all_lost(), .unsent = counters.write_errors});
}

/// That the last turn's set-point could not be sent: the supervisor counts how long that lasts.
void MissionTurn::report_mute() {
  if (is_mute_) take(kOwnPort, messages::UnsentSetpoints{.count = memory_.unsent_setpoints + 1});
}

const runtime::Outputs& MissionTurn::as_published(bool is_durable) {
  if (is_durable || outputs_.acknowledgements.empty()) return outputs_;
  published_ = outputs_;
  for (messages::CommandAcknowledgement& acknowledgement : published_.acknowledgements) {
    if (acknowledgement.outcome == messages::CommandOutcome::kObeyed) acknowledgement.outcome = messages::CommandOutcome::kObeyedNotDurable;
  }
  return published_;
}

bool MissionTurn::record(Time now, const runtime::Outputs& outputs) {
  const bool is_new_state = memory_.recorded_state != outputs.health.state;
  for_each_record(outputs, is_new_state, [&](std::string_view channel, const auto& message, Priority priority) {
    append(now, channel, wire::Encoded(message, now).bytes(), priority);
  });
  return is_new_state;
}

}  // namespace earshot::board
