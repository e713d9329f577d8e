#include "hil/nodes/vehicle_events.hpp"

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "firmware/messages/dictionary/mission_words.hpp"
#include "firmware/wire/n2k/own/orders.hpp"
#include "firmware/wire/n2k/own/reports.hpp"
#include "firmware/wire/n2k/setpoint.hpp"
#include "tests/hil/nodes/listening.hpp"
#include "tests/support/text/tells.hpp"

namespace earshot::hil {
namespace {

constexpr std::uint8_t kEarshot = 0x40;
using Lines = std::vector<std::string>;

class VehicleEventsTest : public testing::Test {
 protected:
  static VehicleSetup setup() {
    VehicleSetup setup;
    setup.start = {.position = {Meters{12'500}, Meters{3'000}}, .depth = Meters{300}, .heading = {}, .speed = {}};
    setup.source = {.position = {Meters{12'500}, Meters{8'000}}, .snr = [](Meters) { return Decibels{}; }};
    setup.utc = [] { return Time{}; };
    return setup;
  }
  void accept(const n2k::FastPacketFrames& packet) {
    for (const n2k::Frame& frame : packet) vehicle_.accept(frame, Time{});
  }
  void say(messages::MissionState state, messages::EndReason reason) {
    n2k::FastPacketFrames packet;
    messages::Health health;
    health.state = state;
    health.end_reason = reason;
    ASSERT_EQ(n2k::compose_health(health, Time{}, {.source = kEarshot, .sequence = sequence_++}, packet), Status::kOk);
    accept(packet);
  }
  void steer(double heading_rad, double depth_m, Time now) {
    n2k::SetpointFrames frames;
    ASSERT_EQ(
        n2k::compose_setpoint({.heading = Radians{heading_rad}, .speed = MetersPerSecond{2.0}, .depth = Meters{depth_m}, .waypoint = {}},
                              kEarshot, sequence_++, frames),
        Status::kOk);
    for (const n2k::Frame& frame : frames) vehicle_.accept(frame, now);
  }

  EmulatedVehicle vehicle_{setup()};
  VehicleEvents events_{vehicle_, Time{}};
  std::uint8_t sequence_ = 0;
};

TEST_F(VehicleEventsTest, TellsOfEachStateOnceAndWhyASearchEnded) {
  EXPECT_EQ(events_.lines(Time{}), Lines{});
  say(messages::MissionState::kStandby, messages::EndReason::kNone);
  EXPECT_TRUE(support::lines_tell(events_.lines(Time{1'000'000}), {{"0:00:01", "address 64", "STANDBY"}}));
  say(messages::MissionState::kStandby, messages::EndReason::kNone);
  EXPECT_EQ(events_.lines(Time{2'000'000}), Lines{});
  say(messages::MissionState::kDone, messages::EndReason::kCompleted);
  EXPECT_TRUE(support::lines_tell(events_.lines(Time{4'830'000'000}),
                                  {{"1:20:30", "address 64", "DONE", messages::to_string(messages::EndReason::kCompleted)}}));
}

TEST_F(VehicleEventsTest, TellsOfADecisionWithHowFarTheSourceReallyIs) {
  n2k::FastPacketFrames packet;
  messages::Decision decision;
  decision.step = 2;
  decision.position = {Meters{12'500}, Meters{3'000}};
  decision.snr = Decibels{11.26};
  decision.waypoint = {Meters{12'500}, Meters{4'000}};
  ASSERT_EQ(n2k::compose_decision(decision, {.source = kEarshot, .sequence = 0}, packet), Status::kOk);
  accept(packet);
  EXPECT_TRUE(support::lines_tell(events_.lines(Time{}), {{"0:00:00", "step 2", "12.50 km north", "3.00 km east", "11.3 dB",
                                                           "12.50 km north", "4.00 km east", "5.00 km"}}));
}

TEST_F(VehicleEventsTest, TellsOfAnotherCourseAndNotOfOneThatIsKept) {
  steer(1.5707963, 300.0, Time{});
  EXPECT_TRUE(support::lines_tell(events_.lines(Time{}), {{"0:00:00", "autopilot", "090 degrees", "2.0 m/s", "300 m"}}));
  steer(1.90, 300.0, Time{});
  EXPECT_EQ(events_.lines(Time{}), Lines{});
  steer(-0.0001, 300.0, Time{});
  EXPECT_TRUE(support::lines_tell(events_.lines(Time{}), {{"0:00:00", "autopilot", "000 degrees", "2.0 m/s", "300 m"}}));
  steer(-0.0001, 0.0, Time{});
  EXPECT_TRUE(support::lines_tell(events_.lines(Time{}), {{"0:00:00", "autopilot", "000 degrees", "2.0 m/s", "0 m"}}));
}

TEST_F(VehicleEventsTest, TellsOnceThatSetPointsStayAway) {
  steer(1.0, 300.0, Time{});
  (void)events_.lines(Time{});
  (void)run(vehicle_, Time{}, Time{11'000'000});
  EXPECT_TRUE(support::lines_tell(events_.lines(Time{11'000'000}), {{"0:00:11", "autopilot", "no", "10 s", "up"}}));
  EXPECT_EQ(events_.lines(Time{11'000'000}), Lines{});
}

TEST_F(VehicleEventsTest, TellsOfAStateAgainWhenItHasComeBackToIt) {
  for (const auto& [state, name] :
       {std::pair{messages::MissionState::kStandby, "STANDBY"}, std::pair{messages::MissionState::kSearch, "SEARCH"},
        std::pair{messages::MissionState::kStandby, "STANDBY"}}) {
    say(state, messages::EndReason::kNone);
    EXPECT_EQ(events_.lines(Time{}), Lines{std::string("0:00:00  Earshot, address 64, is in ") + name});
    EXPECT_EQ(events_.lines(Time{}), Lines{});
  }
}

TEST_F(VehicleEventsTest, TellsAgainThatSetPointsStayAwayWhenSomeCameBetween) {
  for (const std::int64_t s : {0, 11}) {
    steer(1.0, 300.0, Time{s * 1'000'000});
    (void)events_.lines(Time{s * 1'000'000});
    (void)run(vehicle_, Time{s * 1'000'000}, Time{(s + 11) * 1'000'000});
    EXPECT_TRUE(support::lines_tell(events_.lines(Time{(s + 11) * 1'000'000}),
                                    {{"0:00", std::to_string(s + 11), "autopilot", "no", "10 s", "up"}}));
  }
}

TEST_F(VehicleEventsTest, TellsOnceThatTheDropWeightIsReleased) {
  for (std::uint8_t i = 0; i < 2; ++i) {
    n2k::SetpointFrames frames;
    ASSERT_EQ(n2k::compose_setpoint({.heading = {}, .speed = {}, .depth = {}, .waypoint = {}, .release_weight = true}, kEarshot,
                                    sequence_++, frames),
              Status::kOk);
    for (const n2k::Frame& frame : frames) vehicle_.accept(frame, Time{});
    const Lines expected =
        i == 0 ? Lines{"0:00:00  autopilot: releases the drop weight", "0:00:00  autopilot: steers 000 degrees, 0.0 m/s, 0 m deep"}
               : Lines{};
    EXPECT_EQ(events_.lines(Time{}), expected) << int{i};
  }
}

TEST_F(VehicleEventsTest, TellsHowAnOrderWasAnswered) {
  (void)run(vehicle_, Time{}, Time{300'000});
  say(messages::MissionState::kStandby, messages::EndReason::kNone);
  (void)run(vehicle_, Time{300'000}, Time{400'000});
  n2k::FastPacketFrames packet;
  const messages::CommandAcknowledgement answer{
      .time = {}, .port = 1, .issuer = 1, .number = 1, .order = messages::Order::kStart, .outcome = messages::CommandOutcome::kObeyed};
  ASSERT_EQ(n2k::compose_acknowledgement(answer, {.source = kEarshot, .destination = 0x29, .sequence = 0}, packet), Status::kOk);
  accept(packet);
  const Lines lines = events_.lines(Time{});
  ASSERT_FALSE(lines.empty());
  EXPECT_EQ(lines[0], "0:00:00  operator: START: obeyed");
}

TEST_F(VehicleEventsTest, SumsUpTheVoyage) {
  steer(0.0, 300.0, Time{});
  EXPECT_TRUE(support::tells(events_.summary(Time{3'661'000'000}), {"0.00 km", "1:01:01", "1 set-points"}));
}

}  // namespace
}  // namespace earshot::hil
