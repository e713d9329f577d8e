#include "firmware/boards/cortex_m7/flight_board.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "earshot/board_t.hpp"
#include "earshot/decision_t.hpp"
#include "earshot/hydrophone_block_t.hpp"
#include "earshot/hydrophone_status_t.hpp"
#include "firmware/detector/hydrophone/settings_fields.hpp"
#include "firmware/wire/journal/input_record.hpp"
#include "firmware/wire/lcm/channels.hpp"
#include "firmware/wire/serial/channels.hpp"
#include "tests/firmware/boards/cortex_m7/fake_machine.hpp"
#include "tests/firmware/boards/cortex_m7/mission_message.hpp"
#include "tests/firmware/policy/format/unsigned_file.hpp"
#include "tests/firmware/runtime/mission_rig.hpp"
#include "tests/support/gaussian_noise.hpp"
#include "tests/support/lcm_peer.hpp"

namespace earshot::board {
namespace {

using Bytes = std::vector<std::uint8_t>;

struct Sent {
  std::string channel;
  Time time;
  Bytes data;
  friend bool operator==(const Sent&, const Sent&) = default;
};
std::ostream& operator<<(std::ostream& out, const Sent& sent_record) {
  return out << sent_record.channel << " at " << sent_record.time.us << " us, " << sent_record.data.size() << " bytes";
}

Bytes big_endian(std::uint64_t value, std::size_t size) {
  Bytes bytes(size);
  for (std::size_t i = size; i-- > 0; value >>= 8U) bytes[i] = static_cast<std::uint8_t>(value);
  return bytes;
}

using support::bytes_of;

/// As our own code writes it.
template <class Message>
Bytes written(const Message& message, Time sent = {}) {
  const wire::Encoded encoded(message, sent);
  return {encoded.bytes().begin(), encoded.bytes().end()};
}

template <class Message>
Message message_in(const Sent& sent_record) {
  Message message{};
  EXPECT_EQ(message.decode(sent_record.data.data(), 0, static_cast<int>(sent_record.data.size())),
            static_cast<int>(sent_record.data.size()))
      << sent_record.channel;
  return message;
}

/// A board, and what is at the other end of its line.
class FlightBoardTest : public testing::Test {
 protected:
  FlightBoardTest() { machine::fake() = {}; }

  void send(Time time, std::string_view channel, const Bytes& data) { board_->take(wire::RecordFrame(time, channel, data).bytes()); }

  /// What the board has said since it was last asked.
  std::vector<Sent> sent_since() {
    std::vector<Sent> all;
    Bytes room(wire::kFrameBytes);
    wire::CobsReader reader(room);
    for (const std::uint8_t byte : machine::fake().sent) {
      if (reader.take(byte) != wire::CobsReader::Outcome::kFrame) continue;
      wire::FramedRecord record;
      EXPECT_EQ(wire::read_record_frame(reader.frame(), record), Status::kOk);
      all.push_back({std::string(record.channel), record.time, {record.data.begin(), record.data.end()}});
    }
    machine::fake().sent.clear();
    return all;
  }
  /// The event of the only thing that it said.
  int event() {
    const std::vector<Sent> all = sent_since();
    if (all.size() != 1 || all[0].channel != wire::kBoardChannel) return -1;
    last_ = message_in<board_t>(all[0]);
    return last_.event;
  }

  void send_piece(std::string_view channel, const Bytes& file, std::size_t offset, std::size_t size) {
    Bytes piece = big_endian(offset, 4);
    const Bytes whole = big_endian(file.size(), 4);
    piece.insert(piece.end(), whole.begin(), whole.end());
    const auto begin = file.begin() + static_cast<std::ptrdiff_t>(offset);
    piece.insert(piece.end(), begin, begin + static_cast<std::ptrdiff_t>(size));
    send({}, channel, piece);
  }
  void send_file(std::string_view channel, const Bytes& file) {
    for (std::size_t offset = 0; offset < file.size(); offset += wire::kPieceBytes)
      send_piece(channel, file, offset, std::min(wire::kPieceBytes, file.size() - offset));
  }
  void send_mission() { send({}, wire::kMissionChannel, written(message_of(runtime::paper_mission(), policy_, tables_))); }
  void arm() {
    send_file(wire::kPolicyPieceChannel, policy_);
    send_file(wire::kTablesPieceChannel, tables_);
    send_mission();
    ASSERT_EQ(event(), int{board_t::ARMED});
  }

  void give(const messages::Input& input) {
    const wire::InputRecord record(input);
    send(input.arrival, record.channel(), {record.data().begin(), record.data().end()});
    ++sent_;
  }
  template <class Value>
  void give(Time now, const Value& value) {
    give({.arrival = now, .port = 1, .sequence = 0, .value = value});
  }
  void turn(Time now) { send(now, wire::kTurnChannel, big_endian(sent_, 8)); }

  std::unique_ptr<FlightBoard> board_ = std::make_unique<FlightBoard>();
  Bytes policy_ = policy::unsigned_file(*runtime::frozen(*runtime::policy_that_believes()));
  Bytes tables_ = policy::unsigned_file(*runtime::paper_oceans());
  std::uint64_t sent_ = 0;
  board_t last_{};
};

TEST_F(FlightBoardTest, SaysThatItHasStarted) {
  board_->begin();
  EXPECT_EQ(event(), int{board_t::STARTED});
  EXPECT_EQ(last_.stack_bytes, 1000);
  EXPECT_EQ(last_.stack_used_bytes, 100);
}

TEST_F(FlightBoardTest, DependsOnItsWatchdogFromTheMissionOn) {
  send_file(wire::kPolicyPieceChannel, policy_);
  send_file(wire::kTablesPieceChannel, tables_);
  EXPECT_FALSE(machine::fake().has_watchdog);
  send_mission();
  EXPECT_EQ(event(), int{board_t::ARMED});
  EXPECT_TRUE(machine::fake().has_watchdog);
}

TEST_F(FlightBoardTest, RefusesAMissionWhenAPieceOfItsPolicyIsMissingAndFliesItWhenThatCame) {
  send_piece(wire::kPolicyPieceChannel, policy_, 0, wire::kPieceBytes);
  send_file(wire::kTablesPieceChannel, tables_);
  send_mission();
  ASSERT_EQ(event(), int{board_t::REFUSED});
  EXPECT_EQ(last_.status, static_cast<int>(Status::kCorrupt));
  EXPECT_FALSE(machine::fake().has_watchdog);
  arm();
}

TEST_F(FlightBoardTest, RefusesAMissionWithAnotherPolicysChecksum) {
  send_file(wire::kPolicyPieceChannel, policy_);
  send_file(wire::kTablesPieceChannel, tables_);
  policy_.back() ^= 1U;
  send_mission();
  EXPECT_EQ(event(), int{board_t::REFUSED});
}

TEST_F(FlightBoardTest, WritesNoPieceBehindItsStore) {
  const Bytes before = machine::fake().store;
  send({}, wire::kTablesPieceChannel, {0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 1, 2, 3});
  send({}, wire::kTablesPieceChannel,
       {0, 1, 0xFF, 0xFF, 0, 2, 0, 0, 1, 2, 3});  // half of the store is 0x20000 bytes: a file of that, one byte too far
  send({}, wire::kPolicyPieceChannel, {0, 0, 0, 0, 0, 0, 0, 2, 1, 2, 3});
  send({}, wire::kPolicyPieceChannel, {0, 0, 0});
  EXPECT_EQ(machine::fake().store, before);
}

TEST_F(FlightBoardTest, RefusesAMissionWhosePolicyOrTablesItsStoreDoesNotHold) {
  for (const std::string_view channel : {wire::kPolicyPieceChannel, wire::kTablesPieceChannel}) {
    send_file(wire::kPolicyPieceChannel, policy_);
    send_file(wire::kTablesPieceChannel, tables_);
    send({}, channel, {0, 0, 0, 0, 0, 2, 0, 1, 7});  // half of the store is 0x20000 bytes
    send_mission();
    ASSERT_EQ(event(), int{board_t::REFUSED});
    EXPECT_EQ(last_.status, static_cast<int>(Status::kFull));
  }
  send_file(wire::kTablesPieceChannel, tables_);
  arm();
}

/// What turns of a runtime in this process say, as their records.
std::vector<Sent> sent_by(const runtime::Outputs& outputs, Time now) {
  std::vector<Sent> all;
  if (outputs.setpoint) all.push_back({std::string(wire::kJournalledSetpointChannel), now, written(*outputs.setpoint, now)});
  if (outputs.decision) all.push_back({std::string(wire::kDecisionChannel), now, written(*outputs.decision)});
  for (const messages::SafetyEvent& event : outputs.safety_events)
    all.push_back({std::string(wire::kSafetyEventChannel), now, written(event)});
  for (const messages::CommandAcknowledgement& acknowledgement : outputs.acknowledgements)
    all.push_back({std::string(wire::kAcknowledgementChannel) + ".1", now, written(acknowledgement)});
  all.push_back({std::string(wire::kHealthChannel), now, written(outputs.health, now)});
  return all;
}

TEST_F(FlightBoardTest, SaysByteForByteWhatARuntimeOfThisProcessSays) {
  arm();
  runtime::Runtime own;
  ASSERT_EQ(own.configure(runtime::paper_mission(), policy_, tables_), Status::kOk);
  const runtime::Rig vehicle(*runtime::policy_that_goes(runtime::kNorthward));
  int decisions = 0;
  std::uint64_t inputs = 0;
  for (int second = 1; second <= 1200; ++second) {
    const Time now{1'000'000'000 + Duration::seconds(second).us};
    messages::Navigation navigation = vehicle.navigation_at(now);
    navigation.position.north += Meters{2.0 * second};
    navigation.depth = Meters{300};
    std::vector<messages::Input> arriving{{.arrival = now, .port = 1, .sequence = inputs++, .value = navigation}};
    arriving.push_back(
        {.arrival = now, .port = 1, .sequence = inputs++, .value = messages::SnrMeasurement{.time = now, .snr = Decibels{0.01 * second}}});
    if (second == 2)
      arriving.push_back({.arrival = now, .port = 1, .sequence = inputs++, .value = runtime::command_of(messages::Order::kStart, now)});
    for (const messages::Input& input : arriving) {
      own.take(input);
      give(input);
    }
    turn(now);
    std::vector<Sent> records = sent_since();
    std::erase_if(records, [](const Sent& record) { return record.channel == wire::kBoardChannel; });
    const runtime::Outputs outputs = own.step(now);
    decisions += outputs.decision ? 1 : 0;
    ASSERT_EQ(records, sent_by(outputs, now)) << second << " s";
  }
  EXPECT_EQ(decisions, 3);  // at once, and a kilometre at 2 m/s after the other
}

TEST_F(FlightBoardTest, NoticesInTheNextTurnThatAnInputWasLost) {
  arm();
  ++sent_;  // one that never came
  turn(Time{1'000'000'000});
  const std::vector<Sent> records = sent_since();
  ASSERT_EQ(records.size(), 2U);
  EXPECT_EQ(message_in<board_t>(records[0]).event, int{board_t::INPUTS_LOST});
  EXPECT_EQ(records[1].channel, wire::kHealthChannel);
  turn(Time{1'001'000'000});
  EXPECT_EQ(sent_since().size(), 1U) << "it says so once";
}

TEST_F(FlightBoardTest, CountsWhatIsTornOnTheLine) {
  const wire::RecordFrame frame(Time{1}, wire::kTurnChannel, Bytes(8));
  Bytes torn(frame.bytes().begin(), frame.bytes().end());
  torn.erase(torn.begin() + 3);
  board_->take(torn);
  send({}, "EARSHOT_NOBODY_KNOWS", {1});
  send({}, wire::kPolicyPieceChannel, Bytes(wire::kPieceHeadBytes - 1));
  send({}, wire::kTablesPieceChannel, {0, 0, 0, 2, 0, 0, 0, 1});  // from behind the end of a file of one byte
  board_->begin();
  ASSERT_EQ(event(), int{board_t::STARTED});
  EXPECT_EQ(last_.frames_refused, 4);
}

detector::SoundSettings hearing() {
  detector::SoundSettings settings = detector::fin_whale();
  settings.floor_window = Duration::seconds(60);
  return settings;
}

/// A second of a tone in noise: two blocks of 500 samples, as their driver sends them.
std::vector<hydrophone_block_t> second_of_sound(std::int64_t second, double amplitude, support::GaussianNoise& noise) {
  std::vector<hydrophone_block_t> blocks(2);
  for (std::int64_t half = 0; half < 2; ++half) {
    hydrophone_block_t& block = blocks[static_cast<std::size_t>(half)];
    block = {};
    block.first_sample = 1000 * second + 500 * half;
    block.utime = 1000 * block.first_sample;
    block.sequence = 2 * second + half;
    block.sample_rate_hz = 1000;
    block.channels = 1;
    block.sample_count = 500;
    for (int i = 0; i < block.sample_count; ++i)
      block.samples.push_back(static_cast<float>(1e-3 * double{noise()} + amplitude * std::sin(2.0 * std::numbers::pi * 0.02 * i)));
  }
  return blocks;
}

/// What a detector of this process makes of it, as records of port 3.
std::vector<Sent> heard_by(detector::SoundDetector& detector, const hydrophone_block_t& message, Time now) {
  const messages::HydrophoneBlock block{.time = {message.utime},
                                        .sequence = message.sequence,
                                        .first_sample = message.first_sample,
                                        .sample_rate = Hertz{message.sample_rate_hz},
                                        .gain = Decibels{message.gain_db},
                                        .samples_per_channel = static_cast<std::uint32_t>(message.sample_count),
                                        .overflow_count = 0,
                                        .channels = 1};
  std::vector<Sent> measurements;
  detector.hear(block, message.samples);
  while (const std::optional<detector::Estimate> estimate = detector.next())
    if (estimate->is_snr_measurement())
      measurements.push_back({std::string(wire::kSnrEstimateChannel) + ".3", now, written(estimate->measurement())});
  return measurements;
}

TEST_F(FlightBoardTest, HearsInItsHydrophonesBlocksWhatADetectorOfThisProcessHears) {
  send({}, wire::kHearingChannel, written(hearing()));
  arm();
  detector::SoundDetector detector;
  ASSERT_EQ(detector.configure(hearing()), Status::kOk);
  support::GaussianNoise noise(5);
  std::size_t measurements = 0;
  for (std::int64_t second = 0; second < 120; ++second) {
    const Time now{Duration::seconds(second + 1).us};
    for (const hydrophone_block_t& block : second_of_sound(second, second % 15 == 0 ? 1e-3 : 0.0, noise)) {
      send(now, "EARSHOT_HYDROPHONE_BLOCK.3", bytes_of(block));
      ++sent_;
      const std::vector<Sent> expected = heard_by(detector, block, now);
      measurements += expected.size();
      ASSERT_EQ(sent_since(), expected) << second << " s";
    }
  }
  EXPECT_GT(measurements, 50U);
  turn(Time{Duration::seconds(121).us});
  EXPECT_EQ(sent_since().size(), 1U) << "blocks count among what the turn says that came";
}

TEST_F(FlightBoardTest, GivesItsRuntimeWhatItHears) {
  send({}, wire::kHearingChannel, written(hearing()));
  arm();
  support::GaussianNoise noise(5);
  std::vector<Sent> all;
  for (std::int64_t second = 0; second < 100; ++second) {
    const Time now{Duration::seconds(second + 1).us};
    for (const hydrophone_block_t& block : second_of_sound(second, 0.0, noise)) {
      send(now, "EARSHOT_HYDROPHONE_BLOCK.3", bytes_of(block));
      ++sent_;
    }
    give(now, messages::Navigation{
                  .time = now, .position = {Meters{7000}, Meters{12000}}, .depth = Meters{0}, .heading = Radians{0.5}, .speed = {}});
    if (second == 90) give(now, runtime::command_of(messages::Order::kStart, now));
    turn(now);
    const std::vector<Sent> records = sent_since();
    all.insert(all.end(), records.begin(), records.end());
  }
  EXPECT_TRUE(std::ranges::any_of(all, [](const Sent& record) { return record.channel == wire::kDecisionChannel; }))
      << "a search begins when there is an SNR";
}

TEST_F(FlightBoardTest, SaysOnceThatItsHydrophoneIsDeaf) {
  send({}, wire::kHearingChannel, written(hearing()));
  support::GaussianNoise noise(5);
  std::vector<Sent> all;
  for (std::int64_t second = 0; second < 20; ++second) {
    for (hydrophone_block_t block : second_of_sound(second, 0.0, noise)) {
      std::ranges::fill(block.samples, 0.25F);  // shorted
      send(Time{Duration::seconds(second).us}, "EARSHOT_HYDROPHONE_BLOCK.3", bytes_of(block));
    }
    const std::vector<Sent> records = sent_since();
    all.insert(all.end(), records.begin(), records.end());
  }
  ASSERT_EQ(all.size(), 1U);
  EXPECT_EQ(all[0].channel, "EARSHOT_HYDROPHONE_STATUS.3");
  EXPECT_TRUE(message_in<hydrophone_status_t>(all[0]).deaf);
}

TEST_F(FlightBoardTest, RefusesToListenForWhatNoDetectorHears) {
  detector::SoundSettings settings = hearing();
  settings.band = {.low = Hertz{30}, .high = Hertz{15}};
  send({}, wire::kHearingChannel, written(settings));
  ASSERT_EQ(event(), int{board_t::REFUSED});
  EXPECT_EQ(last_.status, static_cast<int>(Status::kOutOfRange));
}

}  // namespace
}  // namespace earshot::board
