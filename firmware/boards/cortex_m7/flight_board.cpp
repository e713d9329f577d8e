#include "firmware/boards/cortex_m7/flight_board.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <variant>

#include "firmware/boards/cortex_m7/machine.hpp"
#include "firmware/boards/cortex_m7/stack.hpp"
#include "firmware/config/capacities.hpp"
#include "firmware/core/big_endian.hpp"
#include "firmware/core/crc32.hpp"
#include "firmware/detector/hydrophone/settings_fields.hpp"
#include "firmware/wire/journal/input_record.hpp"
#include "firmware/wire/lcm/channels.hpp"
#include "firmware/wire/lcm/encoding.hpp"
#include "firmware/wire/lcm/hydrophone_block.hpp"
#include "firmware/wire/serial/channels.hpp"

namespace earshot::board {

using messages::BoardEvent;

namespace {

/// Of the store: policy and tables have a half each.
std::span<std::uint8_t> place_of_policy() {
  return machine::store().first(machine::store().size() / 2);
}
std::span<std::uint8_t> place_of_tables() {
  return machine::store().subspan(machine::store().size() / 2);
}

/// Dated with the turn.
template <class Message>
void send(Time time, std::string_view channel, const Message& message) {
  machine::send(wire::RecordFrame(time, channel, wire::Encoded(message, time).bytes()).bytes());
}

/// The channel of an acknowledgement with the port that it leaves by.
class PortChannel {
 public:
  PortChannel(std::string_view channel, std::uint8_t port) : size_(channel.size() + 2) {
    char* end = std::copy(channel.begin(), channel.end(), text_.begin());
    end[0] = '.';
    end[1] = static_cast<char>('0' + port);
  }
  [[nodiscard]] std::string_view view() const { return {text_.data(), size_}; }

 private:
  std::array<char, wire::kFrameChannelBytes> text_{};
  std::size_t size_;
};

/// Of "EARSHOT_HYDROPHONE_BLOCK.1" the 1; nothing of another channel.
std::optional<std::uint8_t> port_of_sound(std::string_view channel) {
  constexpr std::string_view kSound = wire::kHydrophoneBlockChannel;
  if (!channel.starts_with(kSound) || channel.size() != kSound.size() + 2 || channel[kSound.size()] != '.') return std::nullopt;
  const int port = channel.back() - '0';
  if (port < 0 || port >= static_cast<int>(config::kMaxPorts)) return std::nullopt;
  return static_cast<std::uint8_t>(port);
}

/// What reads it is gone from the stack when the mission is judged.
__attribute__((noinline)) Status read(std::span<const std::uint8_t> bytes, messages::MissionRecord& ordered) {
  return wire::decode(bytes, ordered);
}

}  // namespace

void FlightBoard::begin() {
  report(Time{}, BoardEvent::kStarted);
}

void FlightBoard::take(std::span<const std::uint8_t> bytes) {
  using Outcome = wire::CobsReader::Outcome;
  for (const std::uint8_t byte : bytes) {
    const Outcome outcome = reader_.take(byte);
    if (outcome == Outcome::kNothing) continue;
    wire::FramedRecord record;
    if (outcome == Outcome::kFrame && wire::read_record_frame(reader_.frame(), record) == Status::kOk) {
      take(record);
    } else {
      ++frames_refused_;
    }
  }
}

void FlightBoard::take(const wire::FramedRecord& record) {
  if (record.channel == wire::kTurnChannel) return turn(record.time, record.data);
  if (record.channel == wire::kPolicyPieceChannel) return keep_piece(record.data, place_of_policy(), policy_);
  if (record.channel == wire::kTablesPieceChannel) return keep_piece(record.data, place_of_tables(), tables_);
  if (record.channel == wire::kMissionChannel) return arm(record.time, record.data);
  if (record.channel == wire::kHearingChannel) return listen_for(record.time, record.data);
  if (const std::optional<std::uint8_t> port = port_of_sound(record.channel)) return hear(*port, record);
  messages::Input input;
  if (wire::read_input(record.channel, record.time, record.data, inputs_, input) != Status::kOk) {
    ++frames_refused_;
    return;
  }
  ++taken_;
  take(input);
}

void FlightBoard::take(const messages::Input& input) {
  constexpr double kNoRpm = 0.0;  // no message tells the thruster's
  if (const auto* navigation = std::get_if<messages::Navigation>(&input.value)) detector_.note_motion(navigation->speed, kNoRpm);
  ++inputs_;
  runtime_.take(input);
}

void FlightBoard::listen_for(Time time, std::span<const std::uint8_t> bytes) {
  detector::SoundSettings settings;
  Status status = wire::decode(bytes, settings);
  if (status == Status::kOk) status = detector_.configure(settings);
  hears_ = status == Status::kOk;
  is_deaf_ = false;
  if (!hears_) report(time, BoardEvent::kRefused, status);
}

void FlightBoard::hear(std::uint8_t port, const wire::FramedRecord& record) {
  wire::HydrophoneMessage message;
  if (wire::read_hydrophone_block(record.data, message) != Status::kOk) {
    ++frames_refused_;
    return;
  }
  ++taken_;
  if (!hears_) return;
  // Where their message came in, which nothing else is read of any more: a room of their own would take 3 KiB of stack.
  const std::span<float> samples(reinterpret_cast<float*>(frame_.data()), message.sample_count());
  wire::copy_samples(message, samples);
  detector_.hear(message.block, samples);
  while (const std::optional<detector::Estimate> estimate = detector_.next()) {
    messages::Input input{.arrival = record.time, .port = port, .sequence = inputs_, .value = {}};
    report_deafness(input, estimate->hearing);
    input.sequence = inputs_;
    input.value = estimate->measurement();
    if (!estimate->is_snr_measurement()) continue;
    transmit(input);
    take(input);
  }
}

void FlightBoard::report_deafness(messages::Input input, detector::Hearing hearing) {
  const std::optional<bool> is_deaf = detector::is_deaf(hearing);
  if (!is_deaf || *is_deaf == is_deaf_) return;
  is_deaf_ = *is_deaf;
  input.value = messages::HydrophoneStatus{.time = input.arrival, .is_deaf = is_deaf_};
  transmit(input);
  take(input);
}

/// Its messages are gone from the stack when the input is taken.
__attribute__((noinline)) void FlightBoard::transmit(const messages::Input& input) {
  const wire::InputRecord record(input);
  machine::send(wire::RecordFrame(input.arrival, record.channel(), record.data()).bytes());
}

void FlightBoard::keep_piece(std::span<const std::uint8_t> piece, std::span<std::uint8_t> place, Incoming& file) {
  if (piece.size() < wire::kPieceHeadBytes) {
    ++frames_refused_;
    return;
  }
  const auto offset = static_cast<std::size_t>(load_big_endian(piece.first(4)));
  const auto size = static_cast<std::size_t>(load_big_endian(piece.subspan(4, 4)));
  const std::span<const std::uint8_t> bytes = piece.subspan(wire::kPieceHeadBytes);
  if (offset > size || bytes.size() > size - offset) {
    ++frames_refused_;
    return;
  }
  if (offset == 0) file = {};
  file.size = size;
  if (size > place.size()) return;  // the mission that needs it is refused
  std::copy(bytes.begin(), bytes.end(), place.begin() + static_cast<std::ptrdiff_t>(offset));
  file.known += bytes.size();
}

void FlightBoard::arm(Time time, std::span<const std::uint8_t> bytes) {
  const Status status = configure(bytes);
  if (status == Status::kOk) machine::begin_watchdog();  // from here on a mission depends on it
  report(time, status == Status::kOk ? BoardEvent::kArmed : BoardEvent::kRefused, status);
}

/// The mission is gone from the stack when it is told what became of it.
__attribute__((noinline)) Status FlightBoard::configure(std::span<const std::uint8_t> bytes) {
  messages::MissionRecord ordered;
  if (const Status status = read(bytes, ordered); status != Status::kOk) return status;
  if (policy_.size > place_of_policy().size() || tables_.size > place_of_tables().size()) return Status::kFull;
  const std::span<const std::uint8_t> policy = place_of_policy().first(policy_.size);
  const std::span<const std::uint8_t> tables = place_of_tables().first(tables_.size);
  const bool is_whole = policy_.known == policy_.size && tables_.known == tables_.size && crc32(policy) == ordered.policy_crc32 &&
                        crc32(tables) == ordered.tables_crc32;
  if (!is_whole) return Status::kCorrupt;
  taken_ = inputs_ = 0;
  return runtime_.configure(ordered.mission, policy, tables);
}

void FlightBoard::turn(Time now, std::span<const std::uint8_t> count) {
  if (count.size() != sizeof(std::uint64_t) || load_big_endian(count) != taken_) {
    report(now, BoardEvent::kInputsLost);
    if (count.size() == sizeof(std::uint64_t)) taken_ = load_big_endian(count);
  }
  const std::uint32_t began = machine::microseconds();
  const runtime::Outputs outputs = runtime_.step(now);
  turn_us_ = machine::microseconds() - began;
  if (outputs.decision) report(now, BoardEvent::kDecided);
  transmit(now, outputs);
}

void FlightBoard::transmit(Time now, const runtime::Outputs& outputs) {
  if (outputs.setpoint) send(now, wire::kJournalledSetpointChannel, *outputs.setpoint);
  if (outputs.decision) send(now, wire::kDecisionChannel, *outputs.decision);
  for (const messages::SafetyEvent& event : outputs.safety_events) send(now, wire::kSafetyEventChannel, event);
  for (const messages::CommandAcknowledgement& acknowledgement : outputs.acknowledgements)
    send(now, PortChannel(wire::kAcknowledgementChannel, acknowledgement.port).view(), acknowledgement);
  send(now, wire::kHealthChannel, outputs.health);
}

void FlightBoard::report(Time time, BoardEvent event, Status status) {
  const messages::BoardReport report{.time = time,
                                     .event = event,
                                     .status = status,
                                     .frames_refused = static_cast<std::uint32_t>(frames_refused_),
                                     .bytes_lost = static_cast<std::uint32_t>(machine::bytes_lost()),
                                     .turn_us = turn_us_,
                                     .stack_bytes = static_cast<std::uint32_t>(stack::size()),
                                     .stack_used_bytes = static_cast<std::uint32_t>(stack::most_used())};
  send(time, wire::kBoardChannel, report);
}

}  // namespace earshot::board
