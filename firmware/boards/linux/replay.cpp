#include "firmware/boards/linux/replay.hpp"

#include <algorithm>
#include <deque>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "firmware/core/crc32.hpp"
#include "firmware/host/toml/table_reader.hpp"
#include "firmware/policy/format/policy_format.hpp"
#include "firmware/runtime/runtime.hpp"
#include "firmware/wire/journal/input_record.hpp"
#include "firmware/wire/lcm/channels.hpp"
#include "firmware/wire/lcm/conversion.hpp"
#include "firmware/wire/lcm/encoding.hpp"

namespace earshot::board {
namespace {

using host::BadInput;

std::unique_ptr<runtime::Runtime> runtime_at_the_beginning(host::JournalReader& journal, const std::filesystem::path& path) {
  const auto refuse = [&path](const std::string& what) -> BadInput { return BadInput(path.string() + ": cannot be replayed: " + what); };
  host::JournalRecord record;
  mission_t mission{};
  if (!journal.next(record) || record.channel != wire::kMissionChannel || wire::decode(record.data, mission) != Status::kOk)
    throw refuse("its first record is no mission");
  if (!journal.next(record) || record.channel != wire::kPolicyChannel) throw refuse("its second record is no policy");
  if (crc32(record.data) != static_cast<std::uint32_t>(mission.policy_crc32))
    throw refuse("its policy is not the one that its mission names");
  const auto policy = std::make_unique<policy::FrozenPolicy>();
  policy::PolicyComplaint complaint;
  if (policy::parse(record.data, *policy, complaint) != Status::kOk) throw refuse("its policy " + std::string(to_string(complaint.fault)));
  auto runtime = std::make_unique<runtime::Runtime>();
  const Status configured = runtime->configure(wire::from_message(mission), *policy);
  if (configured == Status::kCorrupt) throw refuse("its policy " + std::string(to_string(policy::PolicyFault::kGoldenMismatch)));
  if (configured != Status::kOk) throw refuse("its mission does not fit its policy");
  return runtime;
}

/// One turn of the runtime again, record by record.
class Turn {
 public:
  void step(runtime::Runtime& runtime, Time now, ReplayResult& result) {
    const runtime::Outputs outputs = runtime.step(now);
    if (outputs.setpoint) expect(wire::kJournalledSetpointChannel, wire::to_message(*outputs.setpoint, now));
    if (outputs.decision) expect(wire::kDecisionChannel, wire::to_message(*outputs.decision));
    for (const messages::SafetyEvent& event : outputs.safety_events) expect(wire::kSafetyEventChannel, wire::to_message(event));
    for (const messages::CommandAcknowledgement& acknowledgement : outputs.acknowledgements)
      expect(wire::kAcknowledgementChannel, wire::to_message(acknowledgement));
    expect(wire::kHealthChannel, wire::to_message(outputs.health, now));
    ++result.turns;
    if (outputs.decision) ++result.decisions;
  }

  [[nodiscard]] bool is_compared() const { return expected_.empty(); }
  [[nodiscard]] bool takes(const host::JournalRecord& record) {
    const bool same = !expected_.empty() && expected_.front().first == record.channel &&
                      std::ranges::equal(expected_.front().second.bytes(), record.data);
    if (!expected_.empty()) expected_.pop_front();
    return same;
  }

 private:
  template <class Message>
  void expect(std::string_view channel, const Message& message) {
    expected_.emplace_back(channel, wire::Encoded(message));
  }
  std::deque<std::pair<std::string_view, wire::Encoded>> expected_;
};

/// @return whether the record is the journal's last
bool note_end(const host::JournalRecord& record, ReplayResult& result) {
  if (record.channel != wire::kJournalEndChannel) return false;
  wire::ClosingRecord closing;
  if (wire::read_closing_record(record.data, closing) == Status::kOk) result.closing = closing;
  return true;
}

}  // namespace

ReplayResult replay(const std::filesystem::path& path) {
  host::JournalReader journal(path);
  const std::unique_ptr<runtime::Runtime> runtime = runtime_at_the_beginning(journal, path);
  ReplayResult result;
  Turn turn;
  std::uint32_t expected_number = 2;
  for (host::JournalRecord record; journal.next(record); ++expected_number) {
    const bool closes = note_end(record, result);
    if (!result.is_same()) continue;
    if (record.number != expected_number) result.gap = expected_number;
    if (closes || result.gap) continue;
    messages::Input input;
    const Status read = wire::read_input(record.channel, record.time, record.data, result.inputs, input);
    if (read == Status::kOk && turn.is_compared()) {
      runtime->take(input);
      ++result.inputs;
      continue;
    }
    if (read == Status::kUnsupported && turn.is_compared()) turn.step(*runtime, record.time, result);
    if (!turn.takes(record)) result.difference = {.record = record.number, .channel = record.channel};
  }
  result.end = journal.end();
  if (result.is_same() && !turn.is_compared()) result.gap = expected_number;  // its last turn is not whole
  return result;
}

}  // namespace earshot::board
