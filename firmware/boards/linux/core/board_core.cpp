#include "firmware/boards/linux/core/board_core.hpp"

#include <algorithm>
#include <chrono>
#include <stdexcept>
#include <utility>

#include "earshot/command_acknowledgement_t.hpp"
#include "earshot/decision_t.hpp"
#include "earshot/health_t.hpp"
#include "earshot/safety_event_t.hpp"
#include "earshot/setpoint_t.hpp"
#include "firmware/core/big_endian.hpp"
#include "firmware/core/crc32.hpp"
#include "firmware/host/file/bad_input.hpp"
#include "firmware/host/file/printable.hpp"
#include "firmware/wire/journal/input_record.hpp"
#include "firmware/wire/lcm/channels.hpp"
#include "firmware/wire/lcm/conversion.hpp"
#include "firmware/wire/lcm/encoding.hpp"
#include "firmware/wire/lcm/output_conversion.hpp"
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

std::string why(std::int8_t status) {
  switch (static_cast<Status>(status)) {
    case Status::kCorrupt:
      return "it does not repeat what the policy's freezer computed, or a piece of it was lost on the line";
    case Status::kMalformed:
      return "its policy or ocean tables hold more than this board (firmware/boards/cortex_m7/README.md), or are of another version";
    case Status::kOutOfRange:
      return "the mission does not fit its policy, or its ocean tables, with the capacities of this board";
    case Status::kFull:
      return "its capacities are too small for them";
    default:
      return "status " + std::to_string(status);
  }
}

}  // namespace

BoardCore::BoardCore(host::SerialLine line, const config::Mission& mission, std::span<const std::uint8_t> policy,
                     std::span<const std::uint8_t> tables, std::chrono::milliseconds patience)
    : line_(std::move(line)), patience_(patience), mission_(mission) {
  const std::string name = host::printable(line_.path().string());
  send_pieces(wire::kPolicyPieceChannel, policy);
  send_pieces(wire::kTablesPieceChannel, tables);
  mission_t m = wire::to_message(mission, Time{});
  m.policy_crc32 = static_cast<std::int32_t>(crc32(policy));
  m.tables_crc32 = static_cast<std::int32_t>(crc32(tables));
  const wire::Encoded encoded(m);
  send(Time{}, wire::kMissionChannel, encoded.bytes());
  for (board_t report{}; receive_report(report);) {
    note(report);
    if (report.event == board_t::ARMED) return;
    if (report.event == board_t::REFUSED) throw host::BadInput(name + ": the board refuses the mission: " + why(report.status));
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
      note(read<board_t>(record));
      if (last_.event == board_t::STARTED) throw std::runtime_error("the board has begun anew, and knows of no mission");
      if (last_.event == board_t::INPUTS_LOST) throw std::runtime_error("inputs were lost on the way to the board");
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
    outputs.setpoint = wire::from_message(read<setpoint_t>(record));
  } else if (kind == wire::kDecisionChannel) {
    outputs.decision = wire::from_message(read<decision_t>(record));
  } else if (kind == wire::kSafetyEventChannel) {
    static_cast<void>(outputs.safety_events.push_back(wire::from_message(read<safety_event_t>(record))));
  } else if (kind.starts_with(wire::kAcknowledgementChannel)) {
    const auto port = static_cast<std::uint8_t>(kind.back() - '0');
    static_cast<void>(outputs.acknowledgements.push_back(wire::from_message(read<command_acknowledgement_t>(record), port)));
  } else if (kind == wire::kHealthChannel) {
    outputs.health = wire::from_message(read<health_t>(record));
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
      const wire::CobsReader::Said said = reader_.take(received_[read_++]);
      if (said == wire::CobsReader::Said::kNothing) continue;
      if (said == wire::CobsReader::Said::kFrame && wire::read_record_frame(reader_.frame(), record) == Status::kOk) return true;
      ++frames_refused_;
    }
    read_ = 0;
    received_size_ = line_.read(received_, patience);
    if (received_size_ == 0) return false;
  }
}

bool BoardCore::receive_report(board_t& report) {
  for (wire::FramedRecord record; receive(record, kArmingTakesLonger * patience_);) {
    if (record.channel != wire::kBoardChannel) continue;
    report = read<board_t>(record);
    return true;
  }
  return false;
}

void BoardCore::note(const board_t& report) {
  if (report.event == board_t::DECIDED) longest_turn_us_ = std::max(longest_turn_us_, report.turn_us);
  last_ = report;
}

}  // namespace earshot::board
