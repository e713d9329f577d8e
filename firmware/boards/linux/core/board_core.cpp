#include "firmware/boards/linux/core/board_core.hpp"

#include <algorithm>
#include <chrono>
#include <stdexcept>
#include <utility>

#include "firmware/core/big_endian.hpp"
#include "firmware/core/crc32.hpp"
#include "firmware/host/file/bad_input.hpp"
#include "firmware/host/file/printable.hpp"
#include "firmware/wire/journal/input_record.hpp"
#include "firmware/wire/lcm/channels.hpp"
#include "firmware/wire/lcm/encoding.hpp"
#include "firmware/wire/serial/channels.hpp"

namespace earshot::board {
namespace {

constexpr int kArmingTakesLonger = 20;

template <class Message>
Message read(const wire::FramedRecord& record) {
  Message message{};
  if (wire::decode(record.data, message) != Status::kOk)
    throw std::runtime_error("the board sent something that this build does not know, on " + host::printable(record.channel));
  return message;
}

std::string why(Status status, std::size_t policy_bytes, std::size_t tables_bytes) {
  switch (status) {
    case Status::kCorrupt:
      return "it does not repeat what the policy's freezer computed, or a piece of it was lost on the line";
    case Status::kMalformed:
      return "its policy or ocean tables hold more than this board (firmware/boards/cortex_m7/README.md), or are of another version";
    case Status::kOutOfRange:
      return "the mission does not fit its policy, or its ocean tables, with the capacities of this board";
    case Status::kFull:
      return "its capacities are too small for the policy, of " + std::to_string(policy_bytes) + " bytes, or its ocean tables, of " +
             std::to_string(tables_bytes);
    default:
      return "status " + std::to_string(static_cast<int>(status));
  }
}

}  // namespace

BoardCore::BoardCore(host::SerialLine line, const config::Mission& mission, std::span<const std::uint8_t> policy,
                     std::span<const std::uint8_t> tables, std::chrono::milliseconds patience)
    : line_(std::move(line)), patience_(patience), mission_(mission) {
  const std::string name = host::printable(line_.path().string());
  send_pieces(wire::kPolicyPieceChannel, policy);
  send_pieces(wire::kTablesPieceChannel, tables);
  const wire::Encoded encoded(messages::MissionRecord{.mission = mission, .policy_crc32 = crc32(policy), .tables_crc32 = crc32(tables)});
  send(Time{}, wire::kMissionChannel, encoded.bytes());
  for (messages::BoardReport report; receive_report(report);) {
    note(report);
    if (report.event == messages::BoardEvent::kArmed) return;
    if (report.event == messages::BoardEvent::kRefused)
      throw host::BadInput(name + ": the board refuses the mission: " + why(report.status, policy.size(), tables.size()));
  }
  throw host::BadInput(name + ": no board answers");
}

std::optional<messages::CommandOutcome> BoardCore::take(const messages::Input& input) {
  const wire::InputRecord record(input);
  send(input.arrival, record.channel(), record.data());
  ++inputs_;
  return std::nullopt;
}

runtime::Outputs BoardCore::step(Time now) {
  std::array<std::uint8_t, sizeof(std::uint64_t)> count;
  store_big_endian(count, inputs_);
  send(now, wire::kTurnChannel, count);
  runtime::Outputs outputs;
  for (wire::FramedRecord record; receive(record, patience_);) {
    if (record.channel == wire::kBoardChannel) {
      note(read<messages::BoardReport>(record));
      if (last_.event == messages::BoardEvent::kStarted) throw std::runtime_error("the board has begun anew, and knows of no mission");
      if (last_.event == messages::BoardEvent::kInputsLost) throw std::runtime_error("inputs were lost on the way to the board");
      continue;
    }
    put(record, outputs);
    if (record.channel == wire::kHealthChannel && record.time == now) return outputs;
  }
  throw std::runtime_error("the board does not answer");
}

void BoardCore::put(const wire::FramedRecord& record, runtime::Outputs& outputs) {
  const std::string_view kind = record.channel;
  if (kind == wire::kJournalledSetpointChannel) {
    outputs.setpoint = read<messages::Setpoint>(record);
  } else if (kind == wire::kDecisionChannel) {
    outputs.decision = read<messages::Decision>(record);
  } else if (kind == wire::kSafetyEventChannel) {
    static_cast<void>(outputs.safety_events.push_back(read<messages::SafetyEvent>(record)));
  } else if (kind.starts_with(wire::kAcknowledgementChannel)) {
    auto acknowledgement = read<messages::CommandAcknowledgement>(record);
    acknowledgement.port = static_cast<std::uint8_t>(kind.back() - '0');
    static_cast<void>(outputs.acknowledgements.push_back(acknowledgement));
  } else if (kind == wire::kHealthChannel) {
    outputs.health = read<messages::Health>(record);
  }
}

std::string BoardCore::remark() const {
  return "the board's longest turn with a decision took " + std::to_string(longest_turn_us_) + " us by its own clock; it used " +
         std::to_string(last_.stack_used_bytes) + " of " + std::to_string(last_.stack_bytes) + " bytes of stack";
}

void BoardCore::send(Time time, std::string_view channel, std::span<const std::uint8_t> data) {
  line_.write(wire::RecordFrame(time, channel, data).bytes(), patience_);
}

void BoardCore::send_pieces(std::string_view channel, std::span<const std::uint8_t> file) {
  std::array<std::uint8_t, wire::kPieceHeadBytes + wire::kPieceBytes> piece;
  std::size_t offset = 0;
  do {
    const std::span<const std::uint8_t> bytes = file.subspan(offset, std::min(wire::kPieceBytes, file.size() - offset));
    store_big_endian(std::span(piece).first(4), offset);
    store_big_endian(std::span(piece).subspan(4, 4), file.size());
    std::copy(bytes.begin(), bytes.end(), piece.begin() + wire::kPieceHeadBytes);
    send(Time{}, channel, std::span(piece).first(wire::kPieceHeadBytes + bytes.size()));
    offset += bytes.size();
  } while (offset < file.size());
}

bool BoardCore::receive(wire::FramedRecord& record, std::chrono::milliseconds patience) {
  for (;;) {
    while (read_ < received_size_) {
      const wire::CobsReader::Outcome outcome = reader_.take(received_[read_++]);
      if (outcome == wire::CobsReader::Outcome::kNothing) continue;
      if (outcome == wire::CobsReader::Outcome::kFrame && wire::read_record_frame(reader_.frame(), record) == Status::kOk) return true;
      ++frames_refused_;
    }
    read_ = 0;
    received_size_ = line_.read(received_, patience);
    if (received_size_ == 0) return false;
  }
}

bool BoardCore::receive_report(messages::BoardReport& report) {
  for (wire::FramedRecord record; receive(record, kArmingTakesLonger * patience_);) {
    if (record.channel != wire::kBoardChannel) continue;
    report = read<messages::BoardReport>(record);
    return true;
  }
  return false;
}

void BoardCore::note(const messages::BoardReport& report) {
  if (report.event == messages::BoardEvent::kDecided) longest_turn_us_ = std::max(longest_turn_us_, report.turn_us);
  last_ = report;
}

}  // namespace earshot::board
