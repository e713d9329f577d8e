#include "hil/nodes/autopilot.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "firmware/wire/n2k/setpoint.hpp"
#include "firmware/wire/n2k/table/messages.hpp"
#include "tests/hil/nodes/listening.hpp"

namespace earshot::hil {
namespace {

constexpr vehicle::Command kResting{.heading = Radians{1.0}, .speed = MetersPerSecond{0.5}, .depth = Meters{10.0}};

class AutopilotTest : public testing::Test {
 protected:
  void send(double heading_rad, Time now) {
    n2k::SetpointFrames frames;
    const messages::Setpoint setpoint{
        .heading = Radians{heading_rad}, .speed = MetersPerSecond{2.0}, .depth = Meters{300.0}, .waypoint = {}};
    ASSERT_EQ(n2k::compose_setpoint(setpoint, 0x40, sequence_++, frames), Status::kOk);
    for (const n2k::Frame& frame : frames) autopilot_.accept(frame, now);
  }

  Autopilot autopilot_{kResting, 1};
  std::uint8_t sequence_ = 0;
};

TEST_F(AutopilotTest, RestsUntilItIsTold) {
  (void)run(autopilot_, Time{}, Time{60'000'000});
  EXPECT_EQ(autopilot_.command().speed, kResting.speed);
  EXPECT_EQ(autopilot_.command().depth, kResting.depth);
  EXPECT_FALSE(autopilot_.is_forsaken());
}

TEST_F(AutopilotTest, ObeysASetPointAndTellsOfIt) {
  std::vector<messages::Setpoint> heard;
  autopilot_.call_back([&](Time, const messages::Setpoint& setpoint) { heard.push_back(setpoint); });
  send(-1.25, Time{1'000'000});
  EXPECT_EQ(autopilot_.taken(), 1U);
  EXPECT_NEAR(autopilot_.command().heading.value, -1.25, 0.6e-4) << "half of 1e-4 rad, and near a whole turn a little more";
  EXPECT_EQ(autopilot_.command().speed.value, 2.0);
  EXPECT_EQ(autopilot_.command().depth.value, 300.0);
  ASSERT_EQ(heard.size(), 1U);
  EXPECT_EQ(heard[0].depth.value, 300.0);
}

TEST_F(AutopilotTest, StopsAndComesUpOnItsCourseWhenNoSetPointHasComeForTenSeconds) {
  send(0.5, Time{1'000'000});
  (void)run(autopilot_, Time{1'000'000}, Time{11'000'000});
  EXPECT_FALSE(autopilot_.is_forsaken());
  EXPECT_EQ(autopilot_.command().speed.value, 2.0);
  (void)run(autopilot_, Time{11'000'000}, Time{11'000'001});
  EXPECT_TRUE(autopilot_.is_forsaken());
  EXPECT_EQ(autopilot_.command().speed.value, 0.0);
  EXPECT_EQ(autopilot_.command().depth.value, 0.0);
  EXPECT_NEAR(autopilot_.command().heading.value, 0.5, 0.6e-4);
}

TEST_F(AutopilotTest, GoesOnWithTheNextSetPoint) {
  send(0.5, Time{1'000'000});
  (void)run(autopilot_, Time{1'000'000}, Time{20'000'000});
  send(0.7, Time{20'000'000});
  EXPECT_FALSE(autopilot_.is_forsaken());
  EXPECT_EQ(autopilot_.command().speed.value, 2.0);
}

TEST_F(AutopilotTest, SaysOnceASecondThatItFollowsAndWhichSetPointItTookLast) {
  (void)run(autopilot_, Time{}, Time{1'000'000});
  const Frames before = of_group(n2k::kAutopilotStatusPgn, run(autopilot_, Time{1'000'000}, Time{11'000'000}));
  ASSERT_EQ(before.size(), 10U);
  // 65294 = 0xFF0E at priority 3 from 0x23: yes (1) in two bits, no sequence yet.
  EXPECT_EQ(before[0], (n2k::Frame{0x0CFF0E23, 8, {0xFC, 0x9F, 0xFD, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF}}));
  for (int i = 0; i < 3; ++i) send(0.5, Time{11'000'000});
  const Frames after = of_group(n2k::kAutopilotStatusPgn, run(autopilot_, Time{11'000'000}, Time{12'000'000}));
  ASSERT_EQ(after.size(), 1U);
  EXPECT_EQ(after[0].data[3], 2) << "counted from 0";
}

TEST_F(AutopilotTest, SaysThatItDoesNotFollowWhileSomebodyElseHasTheHelm) {
  send(0.5, Time{1'000'000});
  autopilot_.engage(false);
  send(0.7, Time{1'000'000});
  EXPECT_EQ(autopilot_.taken(), 1U);
  const Frames said = of_group(n2k::kAutopilotStatusPgn, run(autopilot_, Time{1'000'000}, Time{60'000'000}));
  ASSERT_FALSE(said.empty());
  EXPECT_EQ(said.back(), (n2k::Frame{0x0CFF0E23, 8, {0xFC, 0x9F, 0xFC, 0x00, 0xFF, 0xFF, 0xFF, 0xFF}}));
  EXPECT_NEAR(autopilot_.command().heading.value, 0.5, 0.6e-4);
  EXPECT_EQ(autopilot_.command().speed.value, 2.0) << "it does not wait for set-points";
}

TEST_F(AutopilotTest, TakesTheNextSetPointWhenItHasTheHelmAgain) {
  autopilot_.engage(false);
  send(0.5, Time{1'000'000});
  EXPECT_EQ(autopilot_.taken(), 0U);
  autopilot_.engage(true);
  send(0.7, Time{2'000'000});
  EXPECT_EQ(autopilot_.taken(), 1U);
  EXPECT_NEAR(autopilot_.command().heading.value, 0.7, 0.6e-4);
}

TEST_F(AutopilotTest, SaysThatItFollowsWhileItIgnoresWhatItTakes) {
  send(0.5, Time{1'000'000});
  autopilot_.obey(false);
  (void)run(autopilot_, Time{1'000'000}, Time{2'000'000});
  send(0.7, Time{2'000'000});
  EXPECT_EQ(autopilot_.taken(), 2U);
  EXPECT_NEAR(autopilot_.command().heading.value, 0.5, 0.6e-4);
  const Frames said = of_group(n2k::kAutopilotStatusPgn, run(autopilot_, Time{2'000'000}, Time{3'000'000}));
  ASSERT_EQ(said.size(), 1U);
  // Yes (1), and the second set-point.
  EXPECT_EQ(said[0], (n2k::Frame{0x0CFF0E23, 8, {0xFC, 0x9F, 0xFD, 0x01, 0xFF, 0xFF, 0xFF, 0xFF}}));
  autopilot_.obey(true);
  send(0.9, Time{3'000'000});
  EXPECT_NEAR(autopilot_.command().heading.value, 0.9, 0.6e-4);
}

TEST_F(AutopilotTest, SendsNothingElseButWhatEveryDeviceDoes) {
  for (const n2k::Frame& frame : run(autopilot_, Time{}, Time{10'000'000})) {
    const std::uint32_t pgn = n2k::parse_identifier(frame.identifier).value().pgn;
    EXPECT_TRUE(pgn == n2k::kAutopilotStatusPgn || pgn == n2k::kAddressClaimPgn || pgn == n2k::kRequestPgn || pgn == n2k::kHeartbeatPgn)
        << pgn;
  }
}

}  // namespace
}  // namespace earshot::hil
