#include "firmware/boards/linux/replay/playback.hpp"

#include <algorithm>
#include <string_view>

#include "firmware/boards/linux/turn/turn_records.hpp"
#include "firmware/host/file/bad_input.hpp"
#include "firmware/host/file/printable.hpp"
#include "firmware/host/journal/reading/decode_record.hpp"
#include "firmware/wire/journal/input_record.hpp"
#include "firmware/wire/lcm/channels.hpp"

namespace earshot::board {
namespace {

/// The year 3111: no mission lasts so long, and whatever it adds to a date fits.
constexpr Time kLatest{std::int64_t{1} << 55U};

/// Between two turns, and neither input nor output.
bool is_remark(std::string_view channel) {
  return channel == wire::kJournalResumedChannel || channel == wire::kControllerTroubleChannel;
}

/// Nothing: of another version of Earshot.
std::optional<messages::ClosingRecord> closing_in(const host::JournalRecord& record) {
  const journal::Content content = journal::decode_record(record.channel, record.time, record.data);
  const auto* const closing = std::get_if<messages::ClosingRecord>(&content);
  return closing != nullptr ? std::optional(*closing) : std::nullopt;
}

}  // namespace

void require_possible_date(const std::filesystem::path& journal, const host::JournalRecord& record) {
  if (record.time < Time{} || record.time > kLatest)
    throw not_replayable(journal, "record " + std::to_string(record.number) + " (" + host::printable(record.channel) +
                                      ") bears a date that no clock gives: " + std::to_string(record.time.us) + " us");
}

Playback::Playback(const std::filesystem::path& journal, std::uint32_t from_step) : path_(journal), file_(journal), from_step_(from_step) {
  begin();
}

void Playback::begin() {
  const Beginning beginning = read_beginning(file_, path_);
  memory_.last = beginning.time;
  const Status configured = runtime_->configure(beginning.flown.mission, *beginning.policy, *beginning.tables);
  if (configured == Status::kCorrupt)
    throw not_replayable(path_, "its policy " + std::string(to_string(policy::PolicyFault::kGoldenMismatch)));
  if (configured != Status::kOk) throw not_replayable(path_, "its mission does not fit its policy, or its ocean tables");
  flown_ = beginning.flown;
  next_number_ = kBeginningRecords;
}

bool Playback::next() {
  if (gap_ || difference_ || closing_ || !file_.next(record_)) return false;
  if (record_.number != next_number_) {
    gap_ = next_number_;
    return false;
  }
  return take(record_);
}

std::optional<messages::ClosingRecord> Playback::closing() {
  if (closing_) return closing_;
  while (record_.channel != wire::kJournalEndChannel && file_.next(record_)) {
  }
  if (record_.channel == wire::kJournalEndChannel) closing_ = closing_in(record_);
  return closing_;
}

std::size_t Playback::records_behind_end() {
  if (!closing()) return 0;
  std::size_t count = 0;
  while (file_.next(record_)) ++count;
  return count;
}

bool Playback::take(const host::JournalRecord& record) {
  if (record.channel == wire::kJournalEndChannel) {
    if (is_comparing_ && is_compared()) compare_end(record);
    return false;
  }
  require_possible_date(path_, record);
  ++next_number_;
  if (is_remark(record.channel) && is_compared()) return true;
  messages::Input input;
  const Status read = wire::read_input(record.channel, record.time, record.data, memory_.inputs, input);
  if (read == Status::kOk && is_compared()) {
    memory_.note(input);
    runtime_->take(input);
    return true;
  }
  if (read == Status::kUnsupported && is_compared()) step(record.time);
  if (!is_comparing_ && read == Status::kUnsupported) {
    if (record.channel == wire::kHealthChannel) compared_ = expected_.size();  // which ends every turn
    return true;
  }
  const bool is_output_due = !is_compared();
  if (is_as_expected(record)) return true;
  difference_ = {.record = record.number, .channel = record.channel, .time = record.time, .data = record.data, .now = std::nullopt};
  if (is_output_due) difference_->now = expected_[compared_ - 1];
  return false;
}

void Playback::step(Time now) {
  outputs_ = runtime_->step(now);
  expected_.clear();
  compared_ = 0;
  const bool is_new_state = memory_.recorded_state != outputs_.health.state;
  for_each_record(outputs_, is_new_state, [this, now](std::string_view channel, const auto& message, host::Priority priority) {
    expected_.push_back({.channel = channel, .message = wire::Encoded(message, now), .priority = priority, .time = now});
  });
  memory_.note(now, outputs_);
  ++turns_;
  if (outputs_.decision) ++decisions_;
  if (outputs_.decision && outputs_.decision->step >= from_step_) is_comparing_ = true;
}

bool Playback::is_as_expected(const host::JournalRecord& record) {
  if (is_compared()) return false;
  const Unwritten& expected = expected_[compared_++];
  return expected.channel == record.channel && expected.time == record.time && std::ranges::equal(expected.message.bytes(), record.data);
}

void Playback::compare_end(const host::JournalRecord& record) {
  const std::optional<messages::ClosingRecord> then = closing_in(record);
  if (!then) return;
  const messages::Health& health = outputs_.health;
  messages::ClosingRecord now = *then;  // why its program ended, and what the disk did not take, only the journal knows
  now.state = health.state;
  now.end_reason = health.end_reason;
  now.steps_taken = health.steps_taken;
  if (now == *then) return;
  difference_ = {
      .record = record.number,
      .channel = record.channel,
      .time = record.time,
      .data = record.data,
      .now = Unwritten{
          .channel = wire::kJournalEndChannel, .message = wire::Encoded(now), .priority = host::Priority::kOrder, .time = record.time}};
}

}  // namespace earshot::board
