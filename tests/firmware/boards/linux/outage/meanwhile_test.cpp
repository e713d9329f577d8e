#include "firmware/boards/linux/outage/meanwhile.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <memory>
#include <vector>

#include "firmware/host/safety_record/record_file.hpp"
#include "tests/firmware/boards/linux/scripted_sea.hpp"
#include "tests/firmware/runtime/mission_rig.hpp"
#include "tests/support/temporary_folder.hpp"

namespace earshot::board {
namespace {

using messages::CommandOutcome;
using messages::MissionState;
using messages::Order;

class MeanwhileTest : public testing::Test {
 protected:
  static constexpr std::uint8_t kPort = 1;

  void SetUp() override {
    auto port = std::make_unique<FakePort>(ports_.next_index(), host_, script_);
    port_ = port.get();
    ports_.add(std::move(port));
    host::SafetyRecord record;
    record.turn = 50;
    record.state = MissionState::kSearch;
    record.is_engaged = true;
    record.deepest = Meters{300};
    record.ascent_speed = MetersPerSecond{0.5};
    safety_.emplace(copies_, host_, record);
    copies_.prepare({});
    meanwhile_.emplace(runtime::paper_mission(), ports_, clock_, *safety_);
  }

  const runtime::Outputs& turn() {
    host_.advance(Duration::seconds(1));
    meanwhile_->turn();
    return port_->published.back();
  }
  void give(Order order) {
    script_.then(host_.since_start(),
                 [order](Clock& clock, InputSink& sink) { sink.take(kPort, runtime::command_of(order, clock.now(), 1)); });
  }

  const support::TemporaryFolder folder_;
  FakeHost host_;
  Script script_;
  FakeClock clock_{host_, script_};
  PortSet ports_;
  FakePort* port_ = nullptr;  ///< of ports_
  host::SafetyCopies copies_{{{.file = folder_ / "record"}}};
  std::optional<SafetyLog> safety_;
  std::optional<Meanwhile> meanwhile_;
};

TEST_F(MeanwhileTest, TellsStopAndComeUpInTheStateThatTheRecordSays) {
  const runtime::Outputs outputs = turn();
  ASSERT_TRUE(outputs.setpoint);
  EXPECT_EQ(outputs.setpoint->depth, Meters{0});
  EXPECT_EQ(outputs.setpoint->speed, MetersPerSecond{0.5});
  EXPECT_EQ(outputs.health.state, MissionState::kSearch);
  EXPECT_EQ(outputs.health.authority, messages::Authority::kCommand);
  EXPECT_EQ(outputs.health.response, config::Response::kSurface);
  EXPECT_FALSE(meanwhile_->abort());
}

TEST_F(MeanwhileTest, ObeysAnAbortForGoodAndNoOtherOrder) {
  give(Order::kResume);
  EXPECT_TRUE(turn().acknowledgements.empty());
  give(Order::kAbort);
  const runtime::Outputs outputs = turn();
  ASSERT_EQ(outputs.acknowledgements.size(), 1U);
  EXPECT_EQ(outputs.acknowledgements[0].outcome, CommandOutcome::kObeyed);
  EXPECT_EQ(outputs.health.state, MissionState::kAbort);
  ASSERT_TRUE(meanwhile_->abort());
  EXPECT_EQ(meanwhile_->abort()->first, kPort);
  EXPECT_EQ(meanwhile_->abort()->second.order, Order::kAbort);
  host::RecordFile file(folder_ / "record");
  ASSERT_TRUE(file.open());
  EXPECT_EQ(file.newest().value_or(host::SafetyRecord{}).end_reason, messages::EndReason::kOperatorAbort);
  give(Order::kAbort);
  EXPECT_EQ(turn().acknowledgements[0].outcome, CommandOutcome::kRepeated);
}

TEST_F(MeanwhileTest, NotesAReleaseInTheRecordBeforeItIsTold) {
  config::Mission mission = runtime::paper_mission();
  const config::Rule rule{
      .condition = config::Condition::kLeak, .persistence = Duration::seconds(2), .response = config::Response::kRelease};
  ASSERT_EQ(mission.safety.rules.push_back(rule), Status::kOk);
  meanwhile_.emplace(mission, ports_, clock_, *safety_);
  script_.then(host_.since_start(),
               [](Clock& clock, InputSink& sink) { sink.take(kPort, messages::VehicleStatus{.time = clock.now(), .has_leak = true}); });
  EXPECT_FALSE(turn().setpoint->release_weight);
  EXPECT_FALSE(safety_->record().is_released);
  (void)turn();
  EXPECT_TRUE(turn().setpoint->release_weight);
  host::RecordFile file(folder_ / "record");
  ASSERT_TRUE(file.open());
  EXPECT_TRUE(file.newest().value_or(host::SafetyRecord{}).is_released);
}

TEST_F(MeanwhileTest, OnceItPassesOnItTakesNoOrderAndStillLooksAtTheHeading) {
  struct Taken final : InputSink {
    void take(std::uint8_t /*port*/, const Value& value) override { values.push_back(value); }
    std::vector<Value> values;
  } taken;
  meanwhile_->pass_on_to(taken);
  give(Order::kAbort);
  script_.then(host_.since_start(), [](Clock& clock, InputSink& sink) {
    messages::Navigation fix;
    fix.time = clock.now();
    fix.position = at(7, 8);
    sink.take(kPort, fix);
  });
  const runtime::Outputs outputs = turn();
  EXPECT_EQ(taken.values.size(), 2U);
  EXPECT_TRUE(outputs.acknowledgements.empty());
  EXPECT_FALSE(meanwhile_->abort());
  ASSERT_TRUE(outputs.setpoint);
  EXPECT_EQ(outputs.setpoint->waypoint.north, Meters{7});
}

}  // namespace
}  // namespace earshot::board
