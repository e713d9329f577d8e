#include "firmware/boards/linux/mission_turn.hpp"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <variant>

#include "firmware/core/crc32.hpp"
#include "firmware/core/math.hpp"
#include "firmware/wire/journal/input_record.hpp"
#include "firmware/wire/lcm/channels.hpp"
#include "firmware/wire/lcm/conversion.hpp"
#include "firmware/wire/lcm/encoding.hpp"

namespace earshot::board {
namespace {

using host::Weight;

template <class Message>
void append(host::Journal& journal, Time now, std::string_view channel, const Message& message, Weight weight) {
  (void)journal.append(now, channel, wire::Encoded(message).bytes(), weight);  // the journal counts what it loses
}

/// A report of the journal itself outlives the streams on the full disk that it is about; it claims nothing of the orders' reserve, for
/// which streams that still wait would be given up.
Weight weight_of(std::uint8_t port, const InputSink::Value& value) {
  if (std::holds_alternative<messages::OperatorCommand>(value)) return Weight::kOrder;
  return port == kOwnPort ? Weight::kSteering : Weight::kStream;
}

/// Between two reports of a journal whose disk comes and goes.
constexpr Duration kBetweenJournalReports = Duration::seconds(60);

}  // namespace

void MissionTurn::record_mission(const config::Mission& mission, std::span<const std::uint8_t> policy, std::string_view build) {
  last_ = clock_.now();
  mission_t m = wire::to_message(mission, last_);
  m.policy_crc32 = static_cast<std::int32_t>(crc32(policy));
  std::copy_n(build.begin(), std::min(build.size(), std::size(m.build)), std::begin(m.build));
  append(journal_, last_, wire::kMissionChannel, m, Weight::kOrder);
  (void)journal_.append(last_, wire::kPolicyChannel, policy, Weight::kOrder);
}

Time MissionTurn::now() {
  last_ = std::max(last_, clock_.now());
  return last_;
}

void MissionTurn::take(std::uint8_t port, const Value& value) {
  const messages::Input input{.arrival = now(), .port = port, .sequence = sequence_++, .value = value};
  const auto* navigation = std::get_if<messages::Navigation>(&value);
  if (navigation != nullptr && messages::is_usable(*navigation)) speed_ = navigation->speed;
  if (navigation != nullptr && navigation->time >= Time{}) ++navigation_taken_;
  const wire::InputRecord record(input);
  (void)journal_.append(input.arrival, record.channel(), record.data(), weight_of(port, value));
  if (news_ != nullptr && port == kOwnPort && std::holds_alternative<messages::OperatorCommand>(value)) news_->tell_stop();
  runtime_.take(input);
}

void MissionTurn::tell_detection(std::uint8_t port, const messages::SoundDetection& detection) {
  ports_.publish_detection(detection);
  if (news_ != nullptr) news_->tell(now(), port, detection);
}

void MissionTurn::tell_chain(std::uint8_t port, const HeardChain& chain) {
  if (news_ != nullptr) news_->tell(port, chain);
}

void MissionTurn::tell_trouble(std::uint8_t port, BusTrouble trouble, bool is_there) {
  if (news_ != nullptr) news_->tell(port, trouble, is_there);
}

runtime::Outputs MissionTurn::operator()() {
  ports_.report_changes(*this);
  const Time turn = now();
  report_journal(turn);
  const runtime::Outputs outputs = runtime_.step(turn);
  record(turn, outputs);
  if (outputs.setpoint) commanded_speed_ = outputs.setpoint->speed;
  ports_.note_speed(is_finite(speed_.value) ? speed_ : commanded_speed_);
  ports_.publish(turn, outputs);
  if (news_ == nullptr) return outputs;
  for (const messages::SafetyEvent& event : outputs.safety_events) news_->tell(event);
  news_->tell(turn, outputs.health);
  return outputs;
}

void MissionTurn::report_journal(Time now) {
  const bool is_fine = journal_.trouble() == host::JournalTrouble::kNone;
  if (is_fine == journal_report_.link_up || now < journal_report_due_) return;
  const host::JournalCounters counters = journal_.counters();
  journal_report_.link_up = is_fine;
  journal_report_.lost = counters.all_lost();
  journal_report_.unsent = counters.write_errors;
  journal_report_due_ = now + kBetweenJournalReports;
  take(kOwnPort, journal_report_);
}

void MissionTurn::record(Time now, const runtime::Outputs& outputs) {
  if (outputs.setpoint)
    append(journal_, now, wire::kJournalledSetpointChannel, wire::to_message(*outputs.setpoint, now), Weight::kSteering);
  if (outputs.decision) append(journal_, now, wire::kDecisionChannel, wire::to_message(*outputs.decision), Weight::kSteering);
  for (const messages::SafetyEvent& event : outputs.safety_events)
    append(journal_, now, wire::kSafetyEventChannel, wire::to_message(event), Weight::kSteering);
  for (const messages::CommandAcknowledgement& acknowledgement : outputs.acknowledgements)
    append(journal_, now, wire::kAcknowledgementChannel, wire::to_message(acknowledgement), Weight::kOrder);
  const bool is_new_state = recorded_state_ != outputs.health.state;
  recorded_state_ = outputs.health.state;
  append(journal_, now, wire::kHealthChannel, wire::to_message(outputs.health, now), is_new_state ? Weight::kOrder : Weight::kStream);
}

}  // namespace earshot::board
