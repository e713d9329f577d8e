#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <utility>
#include <variant>
#include <vector>

#include "firmware/boards/linux/mission_loop.hpp"
#include "firmware/host/journal/journal_reader.hpp"
#include "firmware/wire/journal/input_record.hpp"
#include "firmware/wire/lcm/channels.hpp"
#include "firmware/wire/lcm/encoding.hpp"
#include "tests/firmware/boards/linux/scripted_sea.hpp"
#include "tests/firmware/runtime/mission_rig.hpp"
#include "tests/support/temporary_folder.hpp"

namespace earshot::board {

inline constexpr Duration kPeriod = Duration::seconds(1);

inline Duration seconds(double s) {
  return {std::llround(s * 1e6)};
}

/// A vehicle that lies still in the middle of its area, its real runtime and journal, and everything else in the test's hand.
class AtSea : public testing::Test {
 protected:
  static constexpr std::uint8_t kPort = 1;

  void SetUp() override {
    ASSERT_EQ(runtime_->configure(mission(), *runtime::frozen(*runtime::policy_that_goes(runtime::kNorthward)), {}), Status::kOk);
    journal_ = std::make_unique<host::Journal>(path_, host::JournalOptions{.existing = host::ExistingJournal::kReplace});
    auto port = std::make_unique<FakePort>(ports_.next_index(), host_, script_);
    port_ = port.get();
    ports_.add(std::move(port));
  }
  void TearDown() override { (void)journal_->close(); }

  /// A message as its sender makes it, whose wall clock is this host's; the port moves its date.
  template <class Value>
  void send(Clock& clock, InputSink& sink, Value value) {
    value.time = clock.mission_time_of(value.time);
    sink.take(kPort, value);
  }
  /// It goes slowly northwards, half a metre a second: one that stood still were a fault of its navigation.
  [[nodiscard]] messages::Navigation fix() const {
    return {.time = host_.utc(),
            .position = at(7000 + 5e-7 * static_cast<double>(host_.monotonic().us), 12000),
            .depth = Meters{300},
            .heading = Radians{0},
            .speed = MetersPerSecond{2}};
  }
  /// Scripts put its vehicle elsewhere from one second to the next.
  [[nodiscard]] static config::Mission mission() {
    config::Mission mission = runtime::paper_mission();
    mission.safety.vehicle.max_speed = MetersPerSecond{2000};
    return mission;
  }
  [[nodiscard]] messages::SnrMeasurement snr() const { return {.time = host_.utc(), .snr = Decibels{12}}; }

  /// Navigation and SNR once a second from `from` to `to`, each a tenth before the turn.
  void hear(int from, int to) {
    for (int second = from; second < to; ++second) {
      script_.then(seconds(second + 0.9), [this](Clock& clock, InputSink& sink) {
        send(clock, sink, fix());
        send(clock, sink, snr());
      });
    }
  }
  void order(Duration at, messages::Order order) {
    script_.then(at,
                 [this, order](Clock& clock, InputSink& sink) { sink.take(kPort, runtime::command_of(order, clock.now(), ++commands_)); });
  }
  void stop_at(int second) {
    script_.then(seconds(second), [this](Clock&, InputSink&) { stop_ = true; });
  }

  LoopResult fly() { return fly(clock_); }
  LoopResult fly(Clock& clock) {
    OwnCore core(*runtime_);
    MissionTurn turn(core, ports_, *journal_, clock);
    return board::fly(turn, ports_, clock, {.period = kPeriod, .turns = turns_}, stop_);
  }

  std::vector<messages::Order> journalled_orders() {
    (void)journal_->close();
    host::JournalReader reader(path_);
    std::vector<messages::Order> orders;
    for (host::JournalRecord record; reader.next(record);) {
      messages::Input input;
      if (wire::read_input(record.channel, record.time, record.data, 0, input) != Status::kOk) continue;
      if (const auto* command = std::get_if<messages::OperatorCommand>(&input.value)) orders.push_back(command->order);
    }
    return orders;
  }

  /// Every output of its journal, which is closed, comes again, bit for bit, from a runtime that is given the inputs.
  void expect_journal_repeats() {
    runtime::Runtime again;
    ASSERT_EQ(again.configure(mission(), *runtime::frozen(*runtime::policy_that_goes(runtime::kNorthward)), {}), Status::kOk);
    host::JournalReader reader(path_);
    std::size_t turns = 0;
    std::vector<std::vector<std::uint8_t>> outputs;
    for (host::JournalRecord record; reader.next(record);) {
      messages::Input input;
      if (wire::read_input(record.channel, record.time, record.data, 0, input) == Status::kOk) {
        again.take(input);
        continue;
      }
      outputs.push_back(record.data);
      if (record.channel != wire::kHealthChannel) continue;
      const runtime::Outputs stepped = again.step(record.time);
      std::vector<wire::Encoded> expected;
      if (stepped.setpoint) expected.emplace_back(*stepped.setpoint, record.time);
      if (stepped.decision) expected.emplace_back(*stepped.decision);
      for (const auto& acknowledgement : stepped.acknowledgements) expected.emplace_back(acknowledgement);
      expected.emplace_back(stepped.health, record.time);
      ASSERT_EQ(outputs.size(), expected.size()) << "turn " << turns;
      for (std::size_t i = 0; i < expected.size(); ++i)
        ASSERT_TRUE(std::ranges::equal(outputs[i], expected[i].bytes())) << "turn " << turns;
      outputs.clear();
      ++turns;
    }
    EXPECT_EQ(turns, port_->published.size());
  }

  const support::TemporaryFolder folder_;
  const std::filesystem::path path_ = folder_ / "journal";
  FakeHost host_;
  Script script_;
  FakeClock clock_{host_, script_};
  PortSet ports_;
  FakePort* port_ = nullptr;  ///< of ports_
  host::Turns turns_ = host::Turns::kPeriodic;
  std::uint32_t commands_ = 0;
  std::unique_ptr<runtime::Runtime> runtime_ = std::make_unique<runtime::Runtime>();
  std::unique_ptr<host::Journal> journal_;
  std::atomic<bool> stop_{false};
};

}  // namespace earshot::board
