#include "hil/nodes/lcm/lcm_vehicle.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>

#include "earshot/autopilot_status_t.hpp"
#include "earshot/hydrophone_status_t.hpp"
#include "earshot/nav_state_t.hpp"
#include "earshot/snr_estimate_t.hpp"
#include "earshot/vehicle_status_t.hpp"
#include "firmware/wire/lcm/channels.hpp"
#include "firmware/wire/lcm/encoding.hpp"
#include "tests/hil/seconds.hpp"
#include "tests/support/lcm_peer.hpp"

namespace earshot::hil {
namespace {

template <class Type>
Type sent_on(std::string_view channel, const LcmMessages& sent) {
  Type value{};
  for (const LcmMessage& message : sent) {
    if (message.channel != channel) continue;
    EXPECT_EQ(support::read_peer(message.data, value), Status::kOk);
  }
  return value;
}

/// North at 2 m/s in 300 m, 1 km from the source, over a floor of 350 m.
class LcmVehicleTest : public testing::Test {
 protected:
  LcmMessages step(Time now) {
    LcmMessages sent;
    vehicle_.step(now, sent);
    return sent;
  }
  void steer(double depth_m, double speed_mps = 2) {
    const messages::Setpoint setpoint{.heading = {}, .speed = MetersPerSecond{speed_mps}, .depth = Meters{depth_m}, .waypoint = {}};
    const wire::Encoded encoded(setpoint, Time{});
    vehicle_.accept({.channel = std::string(wire::kSetpointChannel), .data = {encoded.bytes().begin(), encoded.bytes().end()}}, at_s(0));
  }
  LcmVehicle vehicle_{{.start = {.position = {}, .depth = Meters{300}, .heading = {}, .speed = MetersPerSecond{2}},
                       .source = {.position = {Meters{1000}, Meters{0}}, .snr = [](Meters range) { return Decibels{range.value / 100}; }},
                       .sea_floor = {.depth = Meters{350}, .reach = Meters{200}}}};
};

TEST_F(LcmVehicleTest, SaysWhereItIsAndHowItIsDatedWithNow) {
  (void)step(at_s(0));
  const LcmMessages sent = step(at_s(10));
  EXPECT_EQ(sent.size(), 5U);
  const auto fix = sent_on<nav_state_t>(wire::kNavStateChannel, sent);
  EXPECT_EQ(fix.utime, 10'000'000);
  EXPECT_NEAR(fix.north_m, 20.0, 1e-9);
  EXPECT_EQ(fix.depth_m, 300.0);
  EXPECT_NEAR(sent_on<snr_estimate_t>(wire::kSnrEstimateChannel, sent).snr_db, 9.8, 1e-9);
  EXPECT_EQ(sent_on<vehicle_status_t>(wire::kVehicleStatusChannel, sent).altitude_m, 50.0);
  EXPECT_TRUE(sent_on<autopilot_status_t>(wire::kAutopilotStatusChannel, sent).follows_setpoints);
}

TEST_F(LcmVehicleTest, FollowsASetPointUntilNoneHasComeForTenSeconds) {
  steer(290);
  (void)step(at_s(0));
  (void)step(at_s(9));
  EXPECT_NEAR(vehicle_.state().depth.value, 295.5, 1e-9) << "half a metre a second";
  EXPECT_FALSE(vehicle_.helm().is_forsaken());
  (void)step(at_s(10));
  EXPECT_TRUE(vehicle_.helm().is_forsaken());
  EXPECT_EQ(vehicle_.helm().command().depth, Meters{0});
}

TEST_F(LcmVehicleTest, TakesNoSetPointThatIsNoneOrThatNoVehicleCanFollow) {
  for (const double depth_m : {std::numeric_limits<double>::quiet_NaN(), -1.0, 1e300}) steer(depth_m);
  for (const double speed_mps : {std::numeric_limits<double>::quiet_NaN(), -1.0, 1e300}) steer(300, speed_mps);
  vehicle_.accept({.channel = std::string(wire::kSetpointChannel), .data = {1, 2, 3}}, at_s(0));
  EXPECT_EQ(vehicle_.helm().taken(), 0U);
}

TEST_F(LcmVehicleTest, SailsOnAsBeforeWhereItIsToldASpeedThatNoVehicleHas) {
  steer(300, 2);
  (void)step(at_s(0));
  for (const double speed_mps : {1e200, -5.0}) steer(300, speed_mps);
  (void)step(at_s(9));
  EXPECT_EQ(vehicle_.state().speed, MetersPerSecond{2});
}

TEST_F(LcmVehicleTest, SaysThatItsHydrophoneIsDeafAndNoSnr) {
  vehicle_.disturb({.hydrophone = {.is_deaf = true, .gain_error = {}}});
  std::set<std::string> channels;
  const LcmMessages sent = step(at_s(1));
  for (const LcmMessage& message : sent) channels.insert(message.channel);
  EXPECT_FALSE(channels.contains(std::string(wire::kSnrEstimateChannel)));
  EXPECT_TRUE(sent_on<hydrophone_status_t>(wire::kHydrophoneStatusChannel, sent).deaf);
}

TEST_F(LcmVehicleTest, SaysThatItsAutopilotDoesNotFollowWhenSomebodyElseSteers) {
  vehicle_.disturb({.is_disengaged = true});
  EXPECT_FALSE(sent_on<autopilot_status_t>(wire::kAutopilotStatusChannel, step(at_s(1))).follows_setpoints);
}

}  // namespace
}  // namespace earshot::hil
