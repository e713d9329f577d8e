// A search on a vehicle whose disk is full.

#include <gtest/gtest.h>

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <thread>
#include <utility>
#include <variant>
#include <vector>

#include "earshot/health_t.hpp"
#include "firmware/boards/linux/mission_turn.hpp"
#include "firmware/boards/linux/port/port_set.hpp"
#include "firmware/boards/linux/replay/replay.hpp"
#include "firmware/host/journal/journal.hpp"
#include "firmware/host/journal/journal_reader.hpp"
#include "firmware/wire/journal/closing_record.hpp"
#include "firmware/wire/journal/input_record.hpp"
#include "firmware/wire/lcm/channels.hpp"
#include "firmware/wire/lcm/encoding.hpp"
#include "tests/firmware/boards/linux/set_clock.hpp"
#include "tests/firmware/runtime/mission_rig.hpp"
#include "tests/support/lcm_peer.hpp"
#include "tests/support/signed_policy.hpp"
#include "tests/support/small_disk.hpp"

namespace earshot::board {
namespace {

using host::PerPriority;
using host::Priority;
using messages::Order;

constexpr std::uint64_t kSmall_bytes = 256 * 1024;
constexpr std::uint64_t kLarge_bytes = 64 * 1024 * 1024;

/// What a journal holds.
struct Contents {
  std::uint64_t setpoints = 0;
  std::uint64_t decisions = 0;
  std::uint64_t records = 0;
  std::uint32_t last = 0;  ///< number
  std::vector<Order> orders;
  std::uint64_t of_orders = 0;  ///< records of that weight
  std::optional<messages::ClosingRecord> closing;
  std::optional<std::uint32_t> first_missing;
  host::JournalReader::End end = host::JournalReader::End::kCorrupt;
};

Contents contents_of(const std::filesystem::path& path) {
  host::JournalReader reader(path);
  Contents contents;
  int state = -1;
  for (host::JournalRecord record; reader.next(record); ++contents.records) {
    contents.last = record.number;
    if (record.number != contents.records && !contents.first_missing) contents.first_missing = contents.records;
    if (record.channel == wire::kJournalledSetpointChannel) ++contents.setpoints;
    if (record.channel == wire::kDecisionChannel) ++contents.decisions;
    for (const std::string_view channel : {wire::kMissionChannel, wire::kPolicyChannel, wire::kAcknowledgementChannel})
      if (record.channel == channel) ++contents.of_orders;
    health_t health{};
    if (record.channel == wire::kHealthChannel && support::read_peer(record.data, health) == Status::kOk &&
        std::exchange(state, static_cast<int>(health.state)) != health.state)
      ++contents.of_orders;
    if (messages::ClosingRecord closing; record.channel == wire::kJournalEndChannel) {
      EXPECT_EQ(wire::read_closing_record(record.data, closing), Status::kOk);
      contents.closing = closing;
    }
    messages::Input input;
    if (wire::read_input(record.channel, record.time, record.data, 0, input) != Status::kOk) continue;
    if (const auto* command = std::get_if<messages::OperatorCommand>(&input.value)) {
      contents.orders.push_back(command->order);
      ++contents.of_orders;
    }
  }
  contents.end = reader.end();
  return contents;
}

/// GIVEN a search under way when the disk of its journal is full, and so much navigation that the buffer is, too.
class FullDisk : public testing::Test {
 protected:
  void SetUp() override {
    if (!disk_) GTEST_SKIP() << "this kernel lets only root mount a file system";
    const policy::FrozenPolicy policy = support::random_walk_policy();
    config::Mission mission = runtime::paper_mission();
    mission.operating_area = {.south_west = {}, .north_east = policy.area_size};
    mission.step_length = policy.step_length;
    mission.detection_threshold = policy.detection_threshold;
    ASSERT_EQ(runtime_->configure(mission, policy, {}), Status::kOk);
    journal_ = std::make_unique<host::Journal>(path_);
    turn_ = std::make_unique<MissionTurn>(core_, ports_, *journal_, clock_);
    const std::vector<std::uint8_t> bytes = support::signed_bytes(policy);
    turn_->record_mission(mission, {.policy = bytes, .tables = {}, .build = "of a test"});
    make_turn(1);
    order(Order::kStart);
    while (of(journal_->counters().lost, Priority::kStream) == 0) make_turn(500);
    for (int i = 0; i < 100; ++i) make_turn(100);
    ASSERT_GT(setpoints_, 100U);
  }

  /// A turn a second, before which so many fixes have come.
  void make_turn(int fixes) {
    clock_.time = clock_.time + Duration::seconds(1);
    ++turns_;
    for (int i = fixes; i > 0; --i) {
      turn_->take(1, messages::Navigation{.time = clock_.time + Duration{-i},
                                          .position = at(12'000 + 1.0 * turns_, 12'000),
                                          .depth = Meters{300},
                                          .heading = Radians{0},
                                          .speed = MetersPerSecond{2}});
    }
    turn_->take(1, messages::SnrMeasurement{.time = clock_.time, .snr = Decibels{3}});
    const runtime::Outputs outputs = (*turn_)();
    if (outputs.setpoint) ++setpoints_;
    if (outputs.decision) ++decisions_;
    health_ = outputs.health;
  }

  /// What the health says of the journal; of the only port that has anything to say.
  [[nodiscard]] std::optional<messages::PortReport> journal_in_health() const {
    return health_.ports.empty() ? std::nullopt : std::optional(health_.ports[0]);
  }

  void order(Order order) { turn_->take(1, runtime::command_of(order, clock_.time, ++commands_)); }

  [[nodiscard]] bool is_flushed() {
    for (const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(30); std::chrono::steady_clock::now() < deadline;) {
      if (journal_->flush() == Status::kOk) return true;
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return false;
  }

  const std::unique_ptr<support::SmallDisk> disk_ = support::SmallDisk::make(kSmall_bytes);
  const std::filesystem::path path_ = disk_ ? disk_->path() / "journal.lcmlog" : std::filesystem::path();
  SetClock clock_;
  PortSet ports_;
  std::unique_ptr<runtime::Runtime> runtime_ = std::make_unique<runtime::Runtime>();
  OwnCore core_{*runtime_};
  std::unique_ptr<host::Journal> journal_;
  std::unique_ptr<MissionTurn> turn_;
  int turns_ = 0;
  std::uint32_t commands_ = 0;
  std::uint64_t setpoints_ = 0;  ///< that came out
  std::uint64_t decisions_ = 0;  ///< likewise
  messages::Health health_;      ///< of the last turn
};

TEST_F(FullDisk, WhenAnAbortComesAndThenRoomTheAbortAndAllSetPointsAreInTheFileAndReplaySaysWhereItIsNoLongerWhole) {
  order(Order::kAbort);
  for (int i = 0; i < 5; ++i) make_turn(100);
  ASSERT_TRUE(disk_->resize(kLarge_bytes));
  ASSERT_TRUE(is_flushed());
  journal_->conclude({});
  ASSERT_EQ(journal_->close(), Status::kOk) << "what waited is written";

  const Contents contents = contents_of(path_);
  EXPECT_EQ(contents.end, host::JournalReader::End::kWhole);
  EXPECT_EQ(contents.orders, (std::vector{Order::kStart, Order::kAbort}));
  EXPECT_EQ(contents.setpoints, setpoints_);
  const PerPriority lost = journal_->counters().lost;
  EXPECT_GT(of(lost, Priority::kStream), 10'000U);
  EXPECT_EQ(of(lost, Priority::kSteering), 0U);
  EXPECT_EQ(of(lost, Priority::kOrder), 0U);
  EXPECT_EQ(contents.records + journal_->counters().all_lost(), contents.last + 1U) << "every record is there or counted";
  const ReplayResult replayed = replay(path_);
  EXPECT_FALSE(replayed.is_same());
  EXPECT_EQ(replayed.gap, contents.first_missing);
  EXPECT_FALSE(replayed.difference) << "what stands before the gap is given again";
}

TEST_F(FullDisk, WhenItStaysFullToTheEndEveryOrderIsInTheFileAndTheLastRecordCountsWhatIsNot) {
  order(Order::kAbort);
  for (int i = 0; i < 5; ++i) make_turn(100);
  journal_->conclude({.time = clock_.time, .state = messages::MissionState::kAbort, .end_reason = messages::EndReason::kOperatorAbort});
  (void)journal_->close();

  const Contents contents = contents_of(path_);
  EXPECT_EQ(contents.end, host::JournalReader::End::kWhole);
  const PerPriority lost = journal_->counters().lost;
  EXPECT_EQ(contents.orders, (std::vector{Order::kStart, Order::kAbort}));
  EXPECT_EQ(contents.setpoints + contents.decisions + of(lost, Priority::kSteering), setpoints_ + decisions_);
  // Mission, policy, two commands with their acknowledgements, three states.
  EXPECT_EQ(contents.of_orders, 9U);
  EXPECT_EQ(of(lost, Priority::kOrder), 0U);
  ASSERT_TRUE(contents.closing);
  EXPECT_EQ(contents.closing->end_reason, messages::EndReason::kOperatorAbort);
  EXPECT_EQ(contents.closing->lost, (messages::LostRecords{.streams = lost[0], .steering = lost[1], .orders = lost[2]}));
  EXPECT_EQ(contents.records + contents.closing->lost.all(), contents.last + 1U) << "every record is there or counted";
  const ReplayResult replayed = replay(path_);
  EXPECT_EQ(replayed.gap, contents.first_missing);
  ASSERT_TRUE(replayed.closing);
  EXPECT_EQ(replayed.closing->lost, contents.closing->lost);
}

TEST_F(FullDisk, IsInTheHealthWhileItIsFullAndNoLongerWhenThereIsRoomAgain) {
  ASSERT_TRUE(journal_in_health());
  EXPECT_EQ(journal_in_health()->port, kOwnPort);
  EXPECT_FALSE(journal_in_health()->link_up);
  EXPECT_EQ(journal_->trouble(), host::JournalTrouble::kTakesNothing);
  ASSERT_TRUE(disk_->resize(kLarge_bytes));
  ASSERT_TRUE(is_flushed());
  EXPECT_EQ(journal_->trouble(), host::JournalTrouble::kNone);
  make_turn(1);
  EXPECT_TRUE(journal_in_health()->link_up);
  EXPECT_GT(journal_in_health()->unsent, 0U) << "writes that failed";
  EXPECT_EQ(journal_in_health()->lost, journal_->counters().all_lost());
}

}  // namespace
}  // namespace earshot::board
