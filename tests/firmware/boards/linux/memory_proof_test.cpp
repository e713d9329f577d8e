// Whole missions through the one loop, at sea and in lock-step, over a real LCM port and a real journal, in which no thread asks for
// memory; and loops in which one does. earshotd --prove-no-alloc is tests/scenario/no_allocation_test.cpp.

#include "firmware/boards/linux/memory_proof.hpp"

#include <gtest/gtest.h>
#include <sys/mman.h>
#include <unistd.h>

#include <atomic>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <ostream>
#include <string>
#include <utility>

#include "firmware/boards/linux/clock/host_mission_clock.hpp"
#include "firmware/boards/linux/lcm_port.hpp"
#include "firmware/boards/linux/mission_loop.hpp"
#include "firmware/host/journal/journal.hpp"
#include "firmware/host/transport/lcm_url.hpp"
#include "tests/firmware/runtime/mission_rig.hpp"
#include "tests/support/private_network.hpp"
#include "tests/support/temporary_folder.hpp"

namespace earshot::board {
namespace {

namespace fs = std::filesystem;
using host::Role;
using messages::MissionState;
using messages::Order;

constexpr Duration kPeriod = Duration::seconds(1);

/// A host whose time passes as the loop waits.
class SteppingHost final : public HostClock {
 public:
  [[nodiscard]] Time utc() const override { return kUtc + passed; }
  [[nodiscard]] Duration monotonic() const override { return passed; }
  Duration passed;

 private:
  static constexpr Time kUtc{1'795'000'000'000'000};
};

/// The clock of a mission at sea, whose host does not wait in fact.
class AtSeaClock : public Clock {
 public:
  [[nodiscard]] Time now() override { return clock_.now(); }
  [[nodiscard]] Time mission_time_of(Time utc) override { return clock_.mission_time_of(utc); }
  [[nodiscard]] Time arrival_of(Time utc) override { return clock_.arrival_of(utc); }
  [[nodiscard]] Wake wait(const Awaited& awaited) override {
    wait_for_ports(awaited.ports, Duration{});
    host_.passed = host_.passed + kPeriod;
    return Wake::kTurn;
  }
  [[nodiscard]] bool answered(const runtime::Outputs& outputs, std::uint64_t sent) override { return clock_.answered(outputs, sent); }

 private:
  SteppingHost host_;
  HostMissionClock clock_{host_};
};

/// A simulator's: ticks that count from zero, a turn for each, and over with the mission.
class LockStepClock final : public Clock {
 public:
  [[nodiscard]] Time now() override { return tick_; }
  [[nodiscard]] Time mission_time_of(Time utc) override { return utc; }
  [[nodiscard]] Time arrival_of(Time /*utc*/) override { return tick_; }
  [[nodiscard]] Wake wait(const Awaited& /*awaited*/) override {
    tick_ = tick_ + kPeriod;
    return Wake::kTurn;
  }
  [[nodiscard]] bool answered(const runtime::Outputs& outputs, std::uint64_t /*sent*/) override {
    return outputs.health.state != MissionState::kDone;
  }

 private:
  Time tick_;
};

/// Brings a vehicle that obeys at once; and asks for memory at every turn, if it is told how.
class VehiclePort final : public Port {
 public:
  VehiclePort(std::uint8_t index, std::atomic<bool>& stop)
      : Port(index, {Role::kNavigation, Role::kSnr, Role::kOperator, Role::kAutopilot}), stop_(stop) {
    fix_.position = at(7000, 12000);
  }

  void collect(Clock& clock, InputSink& sink) override {
    if (asks != nullptr) asks();
    const Time now = clock.now();
    const double sailed_m = fix_.speed.value;
    fix_.time = now;
    fix_.position = fix_.position + at(sailed_m * std::cos(fix_.heading.value), sailed_m * std::sin(fix_.heading.value));
    sink.take(index(), fix_);
    sink.take(index(), messages::SnrMeasurement{.time = now, .snr = Decibels{12}});
    if (++turns_ == 3) sink.take(index(), runtime::command_of(Order::kStart, now));
  }
  std::uint64_t publish(Time /*now*/, const runtime::Outputs& outputs) override {
    if (outputs.setpoint) {
      fix_.heading = outputs.setpoint->heading;
      fix_.speed = outputs.setpoint->speed;
      fix_.depth = outputs.setpoint->depth;
    }
    if (outputs.health.state == MissionState::kDone) stop_ = true;
    return 1;
  }
  [[nodiscard]] int file_descriptor() const override { return -1; }
  [[nodiscard]] PortWords words() const override { return {.label = "a vehicle"}; }

  void (*asks)() = nullptr;

 private:
  std::atomic<bool>& stop_;
  messages::Navigation fix_;
  int turns_ = 0;
};

/// Memory by the ways that a port might take.
struct Way {
  const char* name;
  void (*go)();
};
void PrintTo(const Way& way, std::ostream* stream) {
  *stream << way.name;
}

void* volatile kept = nullptr;
struct alignas(256) Wide {
  char bytes[256];
};
const Way kWays[] = {
    {"Malloc",
     [] {
       kept = std::malloc(8);
       std::free(kept);
     }},
    {"AlignedNew",
     [] {
       auto* const made = new Wide;
       kept = made;
       delete made;
     }},
    {"String",
     [] {
       const std::string text(100, 'x');
       kept = const_cast<char*>(text.data());
     }},
    {"Mapping",
     [] {
       kept = ::mmap(nullptr, 4096, PROT_READ, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
       (void)::munmap(kept, 4096);
     }},
};

enum class Mode { kAtSea, kInLockStep };

class ProvenLoop : public testing::Test {
 protected:
  void SetUp() override {
    ENTER_PRIVATE_NETWORK_OR_SKIP();
    ASSERT_EQ(runtime_->configure(runtime::paper_mission(), *runtime::frozen(*runtime::policy_that_wanders()), {}), Status::kOk);
    ports_.add(
        std::make_unique<LcmPort>(ports_.next_index(), host::PortSettings{.name = "status",
                                                                          .kind = host::PortKind::kLcm,
                                                                          .address = std::string(host::kDefaultLcmUrl),
                                                                          .roles = {Role::kOperator, Role::kAutopilot, Role::kStatus}}));
    auto vehicle = std::make_unique<VehiclePort>(ports_.next_index(), stop_);
    vehicle_ = vehicle.get();
    ports_.add(std::move(vehicle));
  }

  /// Flies to the end of the mission with the trap armed.
  void fly(Mode mode) {
    using J = host::JournalOptions;
    host::Journal journal(path_, mode == Mode::kAtSea ? J{.survives = J::Survives::kPowerCut, .existing = host::ExistingJournal::kReplace}
                                                      : J{.when_full = J::WhenFull::kWait, .existing = host::ExistingJournal::kReplace});
    std::unique_ptr<Clock> clock;
    if (mode == Mode::kAtSea) clock = std::make_unique<AtSeaClock>();
    if (mode == Mode::kInLockStep) clock = std::make_unique<LockStepClock>();
    OwnCore core(*runtime_);
    MissionTurn turn(core, ports_, journal, *clock);
    (void)settle_memory();
    proof_.arm();
    result_ = board::fly(turn, ports_, *clock, {.period = kPeriod}, stop_);
    proof_.disarm(result_);
  }

  const support::TemporaryFolder folder_;
  const std::filesystem::path path_ = folder_ / "journal";
  std::atomic<bool> stop_{false};
  std::unique_ptr<runtime::Runtime> runtime_ = std::make_unique<runtime::Runtime>();
  PortSet ports_;
  VehiclePort* vehicle_ = nullptr;  ///< of ports_
  MemoryProof proof_;
  LoopResult result_;
};

TEST_F(ProvenLoop, AsksForNoMemoryInAWholeMissionAtSea) {
  fly(Mode::kAtSea);
  EXPECT_TRUE(proof_.holds()) << proof_.verdict();
  EXPECT_EQ(result_.last.health.steps_taken, 100);
  const std::string turns = std::to_string(result_.turns);
  ASSERT_GT(result_.turns_in[1], 0U);
  EXPECT_EQ(proof_.verdict(), "0 allocations in 2 threads over " + turns + " turns: " + std::to_string(result_.turns_in[0]) +
                                  " in STANDBY, " + std::to_string(result_.turns_in[1]) + " in SEARCH, " +
                                  std::to_string(result_.turns_in[2]) + " in DONE\n");
  EXPECT_EQ(result_.turns_in[0] + result_.turns_in[1] + result_.turns_in[2], result_.turns);
  EXPECT_EQ(proof_.remark(), "");
}

TEST_F(ProvenLoop, AsksForNoMemoryInAWholeMissionInLockStep) {
  fly(Mode::kInLockStep);
  EXPECT_TRUE(proof_.holds()) << proof_.verdict();
  EXPECT_EQ(result_.last.health.steps_taken, 100);
  EXPECT_GT(result_.turns, 40'000) << "some 500 s a step";
}

TEST_F(ProvenLoop, HasItsRingsInMemoryOnceItIsSettled) {
  const host::Journal journal(path_, {.existing = host::ExistingJournal::kReplace});
  const std::uint64_t before = host::process_memory().anonymous;
  (void)settle_memory();
  // The journal's ring and the LCM port's queues were reserved until now, but for what a constructor wrote.
  EXPECT_GT(host::process_memory().anonymous - before, (6U << 20U) + (1U << 20U));
}

class LoopThatAsks : public ProvenLoop, public testing::WithParamInterface<Way> {
 protected:
  void SetUp() override {
    ProvenLoop::SetUp();
    if (vehicle_ == nullptr) return;  // skipped
    config::Mission mission = runtime::paper_mission();
    mission.max_steps = 2;
    ASSERT_EQ(runtime_->configure(mission, *runtime::frozen(*runtime::policy_that_wanders()), {}), Status::kOk);
    vehicle_->asks = GetParam().go;
  }
};

TEST_P(LoopThatAsks, IsFoundOutAtSea) {
  fly(Mode::kAtSea);
  EXPECT_FALSE(proof_.holds());
  EXPECT_NE(proof_.verdict().find("memory was asked for after arming"), std::string::npos) << proof_.verdict();
}

TEST_P(LoopThatAsks, IsFoundOutInLockStep) {
  fly(Mode::kInLockStep);
  EXPECT_FALSE(proof_.holds());
}

INSTANTIATE_TEST_SUITE_P(MemoryProof, LoopThatAsks, testing::ValuesIn(kWays), [](const auto& way) { return way.param.name; });

}  // namespace
}  // namespace earshot::board
