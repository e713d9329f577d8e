#include "firmware/boards/linux/mission_turn.hpp"
#include "firmware/boards/linux/core/core.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

#include "earshot/controller_trouble_t.hpp"
#include "earshot/operator_command_t.hpp"
#include "earshot/unsent_setpoints_t.hpp"
#include "firmware/boards/linux/event_log/event_log.hpp"
#include "firmware/boards/linux/event_log/line_writer.hpp"
#include "firmware/boards/linux/port/port_set.hpp"
#include "firmware/host/file/file_descriptor.hpp"
#include "firmware/host/journal/journal.hpp"
#include "firmware/host/journal/journal_reader.hpp"
#include "firmware/wire/lcm/encoding.hpp"
#include "tests/firmware/boards/linux/set_clock.hpp"
#include "tests/firmware/runtime/mission_rig.hpp"
#include "tests/support/file_size_limit.hpp"
#include "tests/support/lcm_peer.hpp"
#include "tests/support/process.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text/tells.hpp"

namespace earshot::board {
namespace {

/// Remembers how fast it was told that the vehicle is.
class PublishingPort final : public Port, public SoundListener {
 public:
  explicit PublishingPort(std::uint8_t index) : Port(index, {host::Role::kAutopilot}) {}
  void collect(Clock& /*clock*/, InputSink& /*sink*/) override {}
  std::uint64_t publish(Time /*now*/, const runtime::Outputs& outputs) override {
    state = outputs.health.state;
    refused = outputs.health.counters.navigation_refused;
    acknowledgements = outputs.acknowledgements;
    return outputs.setpoint && can_send ? 1 : 0;
  }
  [[nodiscard]] int file_descriptor() const override { return -1; }
  [[nodiscard]] PortWords words() const override { return {.label = "a listener"}; }
  [[nodiscard]] FurtherDuties further_duties() override { return {.sound_listener = this}; }
  void note_speed(MetersPerSecond told) override { speed_mps = told.value; }
  [[nodiscard]] std::uint64_t blocks_heard() const override { return 0; }

  double speed_mps = -1.0;
  messages::MissionState state{};
  std::uint64_t refused = 0;
  runtime::Acknowledgements acknowledgements;
  bool can_send = true;
};

/// Says at its step what became of orders, as a board does, or nothing any more.
class LateCore final : public Core {
 public:
  explicit LateCore(Core& core) : core_(core) {}
  std::optional<messages::CommandOutcome> take(const messages::Input& input) override {
    (void)core_.take(input);
    return std::nullopt;
  }
  [[nodiscard]] runtime::Outputs step(Time now) override {
    if (is_gone) throw std::runtime_error("the board does not answer");
    return core_.step(now);
  }
  [[nodiscard]] const config::Mission& mission() const override { return core_.mission(); }

  bool is_gone = false;

 private:
  Core& core_;
};

/// A vehicle that lies in the middle of its area; what it says of its speed is the test's.
class MissionTurnTest : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_EQ(runtime_->configure(runtime::paper_mission(), *runtime::frozen(*runtime::policy_that_goes(runtime::kNorthward)), {}),
              Status::kOk);
    auto port = std::make_unique<PublishingPort>(ports_.next_index());
    port_ = port.get();
    ports_.add(std::move(port));
  }

  /// A second passes; a fix with this speed and an SNR arrive. @return the speed that the ports are told
  double report_after(double speed_mps) {
    clock_.time = clock_.time + Duration::seconds(1);
    turn_.take(0, messages::Navigation{.time = clock_.time,
                                       .position = at(7000 + ++seconds_, 12000),
                                       .depth = Meters{300},
                                       .heading = Radians{0},
                                       .speed = MetersPerSecond{speed_mps}});
    turn_.take(0, messages::SnrMeasurement{.time = clock_.time, .snr = Decibels{12}});
    (void)turn_();
    return port_->speed_mps;
  }

  /// The records of a channel.
  template <class Message>
  [[nodiscard]] std::vector<Message> journalled(std::string_view channel) {
    EXPECT_EQ(journal_.flush(), Status::kOk);
    std::vector<Message> messages;
    host::JournalReader reader(folder_ / "journal");
    for (host::JournalRecord record; reader.next(record);) {
      if (record.channel != channel) continue;
      EXPECT_EQ(support::read_peer(record.data, messages.emplace_back()), Status::kOk);
    }
    return messages;
  }

  [[nodiscard]] bool is_own_port_up() const {
    return std::ranges::none_of(turn_.outputs().health.ports,
                                [](const auto& report) { return report.port == kOwnPort && !report.link_up; });
  }

  static constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  static constexpr double kCommanded = 2.0;  // the paper's

  const support::TemporaryFolder folder_;
  std::unique_ptr<runtime::Runtime> runtime_ = std::make_unique<runtime::Runtime>();
  PortSet ports_;
  PublishingPort* port_ = nullptr;  ///< of ports_
  SetClock clock_;
  int seconds_ = 0;
  host::Journal journal_{folder_ / "journal", {.existing = host::ExistingJournal::kReplace}};
  OwnCore core_{*runtime_};
  MissionTurn turn_{core_, ports_, journal_, clock_};
};

TEST_F(MissionTurnTest, TellsThePortsTheCommandedSpeedWhereTheFixesHaveNone) {
  EXPECT_EQ(report_after(kNan), 0.0) << "nothing is commanded yet: it must hear before it may start";
  EXPECT_EQ(report_after(1.25), 1.25);
  turn_.take(0, runtime::command_of(messages::Order::kStart, clock_.time, 1));
  EXPECT_EQ(report_after(1.25), 1.25) << "what is measured goes before what is commanded";
  EXPECT_EQ(port_->state, messages::MissionState::kSearch);
  EXPECT_EQ(report_after(kNan), kCommanded);
  turn_.take(0, runtime::command_of(messages::Order::kAbort, clock_.time, 2));
  EXPECT_EQ(report_after(kNan), 0.0) << "it stops and comes up";
  EXPECT_EQ(port_->refused, 0U);
}

// An address that is taken again and again, a socket that takes nothing: 10 s without a set-point, from the turn after the first.
TEST_F(MissionTurnTest, EndsASearchWhoseSetpointsNoPortCanSend) {
  (void)report_after(1.25);
  turn_.take(0, runtime::command_of(messages::Order::kStart, clock_.time, 1));
  for (int s = 0; s < 30; ++s) (void)report_after(1.25);
  EXPECT_EQ(port_->state, messages::MissionState::kSearch);
  port_->can_send = false;
  for (int s = 0; s < 11; ++s) (void)report_after(1.25);
  EXPECT_EQ(port_->state, messages::MissionState::kSearch);
  for (int s = 0; s < 2; ++s) (void)report_after(1.25);
  EXPECT_EQ(port_->state, messages::MissionState::kAbort);
}

// Who reads a port's `malformed` looks for a device that sends what nobody understands.
TEST_F(MissionTurnTest, CountsNoSetpointThatCouldNotBeSentAsABadMessage) {
  (void)report_after(1.25);
  turn_.take(0, runtime::command_of(messages::Order::kStart, clock_.time, 1));
  port_->can_send = false;
  for (int s = 0; s < 5; ++s) (void)report_after(1.25);
  for (const messages::PortReport& report : turn_.outputs().health.ports) EXPECT_EQ(report.malformed, 0U) << int{report.port};
  std::vector<std::int64_t> counts;
  for (const auto& unsent : journalled<unsent_setpoints_t>("EARSHOT_UNSENT_SETPOINTS.0")) counts.push_back(unsent.count);
  EXPECT_EQ(counts, (std::vector<std::int64_t>{1, 2, 3, 4})) << "each in the turn after it";
}

TEST_F(MissionTurnTest, PassesOverTheSpeedOfAFixThatCannotBe) {
  EXPECT_EQ(report_after(1.25), 1.25);
  EXPECT_EQ(report_after(std::numeric_limits<double>::infinity()), 1.25);
  EXPECT_EQ(port_->refused, 1U);
}

TEST_F(MissionTurnTest, WritesTheTroublesOfACanControllerIntoItsJournalAndNoneThatGoByTheHostsClock) {
  (void)report_after(1.25);
  turn_.report_trouble(1, BusTrouble::kErrorPassive, true);
  turn_.report_trouble(1, BusTrouble::kNoPosition, true);
  (void)report_after(1.25);
  turn_.report_trouble(1, BusTrouble::kErrorPassive, false);
  turn_.report_trouble(1, BusTrouble::kBusOff, true);
  (void)report_after(1.25);
  std::vector<std::string> said;
  for (const auto& trouble : journalled<controller_trouble_t>("EARSHOT_CONTROLLER_TROUBLE"))
    said.push_back(std::to_string(trouble.port) + (trouble.trouble == 1 ? " bus-off " : " passive ") +
                   (trouble.is_there != 0 ? "begins" : "ends"));
  EXPECT_EQ(said, (std::vector<std::string>{"1 passive begins", "1 passive ends", "1 bus-off begins"}));
}

TEST_F(MissionTurnTest, SaysAtOnceThatTheDiskTakesNothingThoughItSaidAMomentAgoThatItDoesAgain) {
  const auto is_up = [this] { return is_own_port_up(); };
  const auto wait_for = [this](host::JournalTrouble trouble) {
    (void)report_after(1.25);
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(30);
    while (journal_.trouble() != trouble && std::chrono::steady_clock::now() < deadline)
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    (void)report_after(1.25);
  };
  ASSERT_EQ(journal_.flush(), Status::kOk);
  {
    const support::FileSizeLimit full(1);
    wait_for(host::JournalTrouble::kTakesNothing);
    EXPECT_FALSE(is_up());
  }
  wait_for(host::JournalTrouble::kNone);
  EXPECT_FALSE(is_up()) << "that it comes back is no news to be told every second";
  clock_.time = clock_.time + Duration::seconds(60);
  (void)report_after(1.25);
  EXPECT_TRUE(is_up());
  const support::FileSizeLimit full(1);
  wait_for(host::JournalTrouble::kTakesNothing);
  EXPECT_FALSE(is_up());
}

TEST_F(MissionTurnTest, TellsAPersonThatATightenWasObeyedEvenBeforeTheFirstTurn) {
  const std::filesystem::path said = folder_ / "said.txt";
  host::FileDescriptor out(::open(said.c_str(), O_CREAT | O_WRONLY | O_CLOEXEC, 0600));
  {
    LineWriter writer(out.number());
    EventLog event_log(ports_, writer);
    turn_.report_to(event_log);
    messages::OperatorCommand tighten = runtime::command_of(messages::Order::kTighten, clock_.time, 1);
    tighten.limits.max_speed = MetersPerSecond{1.5};
    turn_.take(0, tighten);
    (void)turn_();
  }
  const std::string text = support::read_text(said);
  EXPECT_NE(text.find(" and 1.50 m/s, never below "), std::string::npos) << text;
}

TEST_F(MissionTurnTest, AFloodOfRefusedOrdersFillsNoDiskIsCountedAndHoldsUpNoAbort) {
  (void)report_after(1.25);
  for (int second = 0; second < 12; ++second) {
    for (std::uint32_t i = 0; i < 10'000; ++i) {
      messages::OperatorCommand old = runtime::command_of(messages::Order::kPause, Time{1}, i);
      old.issuer = i;
      turn_.take(1, old);
    }
    (void)report_after(1.25);
  }
  // 32 and 20 a second of some 300 bytes with their answers; health and what the ports report besides.
  ASSERT_EQ(journal_.flush(), Status::kOk);
  EXPECT_LT(std::filesystem::file_size(folder_ / "journal"), 200'000U);
  const messages::Health& health = turn_.outputs().health;
  EXPECT_GE(health.counters.commands_refused, 200U);
  std::uint64_t lost = 0;
  for (const messages::PortReport& report : health.ports) lost += report.port == 1 ? report.lost : 0;
  EXPECT_EQ(lost + health.counters.commands_refused, 120'000U);
  turn_.take(1, runtime::command_of(messages::Order::kAbort, clock_.time, 1));
  (void)report_after(1.25);
  EXPECT_EQ(port_->state, messages::MissionState::kAbort);
}

// 60,000 orders of some 250 bytes with what is said of them; the buffer holds 8 MiB.
TEST_F(MissionTurnTest, OrdersThatABoardRefusesHaveNoClaimOnTheRoomOfThoseThatAreObeyed) {
  LateCore late(core_);
  MissionTurn turn(late, ports_, journal_, clock_);
  const support::FileSizeLimit full(1);
  for (std::uint32_t i = 0; i < 60'000; ++i) {
    messages::OperatorCommand old = runtime::command_of(messages::Order::kPause, Time{1}, i);
    old.issuer = i;
    turn.take(1, old);
    if (i % 30 != 0) continue;
    clock_.time = clock_.time + Duration::seconds(2);
    (void)turn();
  }
  const host::PerPriority lost = journal_.counters().lost;
  EXPECT_GT(of(lost, host::Priority::kStream), 1000U);
  EXPECT_EQ(of(lost, host::Priority::kOrder), 0U);
}

TEST_F(MissionTurnTest, TheJournalOfABoardIsThatOfARuntimeInThisProcess) {
  const auto journal_of = [this](bool is_late) {
    const std::filesystem::path path = folder_ / (is_late ? "late" : "own");
    auto runtime = std::make_unique<runtime::Runtime>();
    EXPECT_EQ(runtime->configure(runtime::paper_mission(), *runtime::frozen(*runtime::policy_that_goes(runtime::kNorthward)), {}),
              Status::kOk);
    OwnCore own(*runtime);
    LateCore late(own);
    host::Journal journal(path, {.existing = host::ExistingJournal::kReplace});
    PortSet ports;
    ports.add(std::make_unique<PublishingPort>(ports.next_index()));
    SetClock clock;
    MissionTurn turn(is_late ? static_cast<Core&>(late) : own, ports, journal, clock);
    for (std::uint32_t s = 1; s <= 20; ++s) {
      clock.time = clock.time + Duration::seconds(1);
      turn.take(1, messages::SnrMeasurement{.time = clock.time, .snr = Decibels{12}});
      turn.take(1, runtime::command_of(s == 3 ? messages::Order::kStart : messages::Order::kPause, clock.time, s));
      turn.take(1, messages::Navigation{.time = clock.time,
                                        .position = at(7000 + s, 12000),
                                        .depth = Meters{300},
                                        .heading = Radians{0},
                                        .speed = MetersPerSecond{1.25}});
      (void)turn();
    }
    turn.take(1, messages::SnrMeasurement{.time = clock.time, .snr = Decibels{13}});  // what comes after the last turn
    turn.end();
    EXPECT_EQ(journal.close(), Status::kOk);
    return support::read_text(path);
  };
  const std::string own = journal_of(false);
  EXPECT_GT(own.size(), 5000U);
  EXPECT_TRUE(journal_of(true) == own);
}

TEST_F(MissionTurnTest, WhatCameBeforeABoardFellSilentStandsInTheJournal) {
  LateCore late(core_);
  MissionTurn turn(late, ports_, journal_, clock_);
  turn.take(1, runtime::command_of(messages::Order::kAbort, clock_.time, 7));
  late.is_gone = true;
  EXPECT_THROW((void)turn(), std::runtime_error);
  turn.end();
  const auto orders = journalled<operator_command_t>("EARSHOT_OPERATOR_COMMAND.1");
  ASSERT_EQ(orders.size(), 1U);
  EXPECT_EQ(orders.front().number, 7);
}

TEST_F(MissionTurnTest, AnOrderThatNoDiskHasIsAcknowledgedAsNotDurableAndHealthAndAPersonAreTold) {
  const std::filesystem::path said = folder_ / "said.txt";
  host::FileDescriptor out(::open(said.c_str(), O_CREAT | O_WRONLY | O_CLOEXEC, 0600));
  host::SafetyCopies copies({{.file = folder_ / "missing" / "record"}});
  const HostClock host;
  SafetyLog safety(copies, host, {});
  (void)safety.begin(clock_.time, core_.mission(), 0, std::vector<std::uint8_t>{1}, std::chrono::milliseconds(0));
  {
    LineWriter writer(out.number());
    EventLog event_log(ports_, writer);
    turn_.report_to(event_log);
    turn_.keep_safe(safety);
    turn_.take(0, runtime::command_of(messages::Order::kAbort, clock_.time, 1));
    (void)report_after(1.25);
    ASSERT_EQ(port_->acknowledgements.size(), 1U);
    EXPECT_EQ(port_->acknowledgements[0].outcome, messages::CommandOutcome::kObeyedNotDurable);
    EXPECT_EQ(turn_.outputs().acknowledgements[0].outcome, messages::CommandOutcome::kObeyed) << "what a replay says";
    EXPECT_FALSE(is_own_port_up());
    std::filesystem::create_directory(folder_ / "missing");
    for (int i = 0; i < 1000 && !safety.is_durable(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(10));
    clock_.time = clock_.time + Duration::seconds(60);
    (void)report_after(1.25);
    EXPECT_TRUE(is_own_port_up());
  }
  const std::string text = support::read_text(said);
  EXPECT_TRUE(support::has_line(text, {"record", "no", "0.1 s"})) << text;
  EXPECT_NE(text.find("safety record: a disk has it again"), std::string::npos) << text;
}

}  // namespace
}  // namespace earshot::board
