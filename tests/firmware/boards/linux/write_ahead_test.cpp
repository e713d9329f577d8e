// What a turn waits for before it says a word, on a disk of this program that takes its time: fdatasync(2).

#include <gtest/gtest.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <chrono>
#include <memory>
#include <string>
#include <thread>

#include "firmware/boards/linux/core/core.hpp"
#include "firmware/boards/linux/mission_turn.hpp"
#include "firmware/boards/linux/port/port_set.hpp"
#include "tests/firmware/boards/linux/set_clock.hpp"
#include "tests/firmware/runtime/mission_rig.hpp"
#include "tests/support/temporary_folder.hpp"

extern "C" int fdatasync(int file) {
  std::this_thread::sleep_for(std::chrono::milliseconds(50));
  return static_cast<int>(::syscall(SYS_fdatasync, file));
}

namespace earshot::board {
namespace {

using namespace std::chrono_literals;
using messages::MissionState;
using messages::Order;

/// Looks, when it is told to publish, whether all that the journal was given is on the disk.
class ReachPort final : public Port {
 public:
  ReachPort(std::uint8_t index, host::Journal& journal) : Port(index, {}), journal_(journal) {}
  void collect(Clock& /*clock*/, InputSink& /*sink*/) override {}
  std::uint64_t publish(Time /*now*/, const runtime::Outputs& outputs) override {
    is_on_disk = journal_.flush(0ms, host::Journal::Reach::kDisk) == Status::kOk;
    is_in_file = journal_.flush(0ms, host::Journal::Reach::kFile) == Status::kOk;
    said = outputs;
    return 0;
  }
  [[nodiscard]] int file_descriptor() const override { return -1; }
  [[nodiscard]] PortWords words() const override { return {.label = "a listener"}; }

  bool is_on_disk = false;
  bool is_in_file = false;
  runtime::Outputs said;

 private:
  host::Journal& journal_;
};

/// A vehicle in the middle of its area, with a rule that warns of a leak.
class WriteAhead : public testing::Test {
 protected:
  void SetUp() override {
    config::Mission mission = runtime::paper_mission();
    const config::Rule leak{.condition = config::Condition::kLeak, .persistence = {}, .response = config::Response::kWarn};
    ASSERT_EQ(mission.safety.rules.push_back(leak), Status::kOk);
    ASSERT_EQ(runtime_->configure(mission, *runtime::frozen(*runtime::policy_that_goes(runtime::kNorthward)), {}), Status::kOk);
    auto port = std::make_unique<ReachPort>(ports_.next_index(), journal_);
    port_ = port.get();
    ports_.add(std::move(port));
    turn_.write_ahead(20s);
  }

  /// A second passes; a fix and an SNR arrive.
  void pass_second() {
    clock_.time = clock_.time + Duration::seconds(1);
    north_m_ += 2.0;
    turn_.take(0, messages::Navigation{.time = clock_.time,
                                       .position = at(north_m_, 12000),
                                       .depth = Meters{300},
                                       .heading = Radians{0},
                                       .speed = MetersPerSecond{2}});
    turn_.take(0, messages::SnrMeasurement{.time = clock_.time, .snr = Decibels{12}});
  }

  const support::TemporaryFolder folder_;
  host::Journal journal_{folder_ / "journal", {.survives = host::JournalOptions::Survives::kPowerCut}};
  std::unique_ptr<runtime::Runtime> runtime_ = std::make_unique<runtime::Runtime>();
  PortSet ports_;
  ReachPort* port_ = nullptr;  ///< of ports_
  SetClock clock_;
  OwnCore core_{*runtime_};
  MissionTurn turn_{core_, ports_, journal_, clock_};
  double north_m_ = 7000.0;
};

TEST_F(WriteAhead, PutsAnObeyedCommandANewStateAndWhatARuleDoesOnTheDiskBeforeAWordIsSaid) {
  pass_second();
  turn_();
  ASSERT_EQ(port_->said.health.state, MissionState::kStandby);
  EXPECT_TRUE(port_->is_on_disk) << "the first state is new";

  pass_second();
  turn_.take(0, runtime::command_of(Order::kStart, clock_.time, 1));
  turn_();
  ASSERT_EQ(port_->said.acknowledgements.size(), 1U);
  ASSERT_EQ(port_->said.acknowledgements[0].outcome, messages::CommandOutcome::kObeyed);
  EXPECT_TRUE(port_->is_on_disk) << "START is obeyed";

  pass_second();
  turn_();
  ASSERT_TRUE(port_->said.setpoint);
  EXPECT_TRUE(port_->is_in_file) << "a set-point of a search that goes on";

  pass_second();
  turn_.take(0, messages::VehicleStatus{.time = clock_.time, .has_leak = true});
  turn_();
  ASSERT_EQ(port_->said.safety_events.size(), 1U);
  EXPECT_TRUE(port_->is_on_disk) << "a rule acts";
}

}  // namespace
}  // namespace earshot::board
