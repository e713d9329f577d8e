// earshotd at sea, in scaled time, with the devices of an emulated vehicle (hil/nodes) on a CAN bus. Runs where vcan0 is
// (hil/bus/with-can).

#include <gtest/gtest.h>

#include <chrono>
#include <iostream>
#include <string>
#include <vector>

#include "earshot/health_t.hpp"
#include "earshot/operator_command_t.hpp"
#include "earshot/snr_estimate_t.hpp"
#include "firmware/host/transport/lcm_endpoint.hpp"
#include "firmware/messages/health.hpp"
#include "tests/scenario/sea_over_can.hpp"

namespace earshot {
namespace {

using namespace std::chrono_literals;
using messages::CommandOutcome;
using messages::EndReason;
using messages::MissionState;

/// The payload's side of a mission whose vehicle alone is on CAN: a hydrophone and an operator on LCM.
class PayloadOverLcm {
 public:
  explicit PayloadOverLcm(const std::string& url) : endpoint_(host::parse_lcm_url(url), {wire::kHealthChannel}) {}

  /// Says what the hydrophone hears, and START until the search has begun.
  void turn(Decibels snr) {
    endpoint_.collect();
    for (wire::Lc02Message message; endpoint_.take(message) == Status::kOk;) {
      EXPECT_EQ(wire::decode(message.data, health), Status::kOk);
      is_heard_ = true;
    }
    snr_estimate_t estimate{};
    estimate.utime = hil::ScaledClock::utc().us;
    estimate.snr_db = snr.value;
    EXPECT_EQ(endpoint_.publish(wire::kSnrEstimateChannel, wire::Encoded(estimate).bytes()), Status::kOk);
    if (is_heard_ && state() == MissionState::kStandby) start();
  }

  [[nodiscard]] MissionState state() const { return static_cast<MissionState>(health.state); }
  health_t health{};

 private:
  void start() {
    operator_command_t order{};
    order.utime = hil::ScaledClock::utc().us;
    order.expiry_utime = order.utime + 10'000'000;
    order.issuer = 4711;
    order.number = 1;
    order.command = operator_command_t::START;
    EXPECT_EQ(endpoint_.publish(wire::kOperatorCommandChannel, wire::Encoded(order).bytes()), Status::kOk);
  }

  host::LcmEndpoint endpoint_;
  bool is_heard_ = false;
};

TEST_F(SeaOverCan, GivenNavigationAndAutopilotOverCanAndTheRestOverLcmASearchIsSailedToItsLastStepAndItsJournalGivesEveryByteAgain) {
  policy::FrozenPolicy walk = support::random_walk_policy();
  walk.step_length = Meters{200};
  support::write_bytes(folder_ / "walk.policy", support::signed_bytes(walk));
  support::write_public_key(folder_ / "walk.pub");
  std::string mission = patient_mission();
  replace(mission, "step_length_m = 1000.0", "step_length_m = 200.0");
  replace(mission, "max_steps = 100", "max_steps = 6");
  replace(mission, "depth_m = 300.0", "depth_m = 50.0");
  replace(mission, "listening = \"mean\"", "listening = \"newest\"");
  replace(mission, "listening_window_s = 30", "listening_window_s = 0");
  const std::string url = "udpm://239.255.76.67:27491?ttl=0";
  PayloadOverLcm payload(url);
  start_earshotd(mission, {"--lcm-url", url, "--policy", folder_ / "walk.policy", "--public-key", folder_ / "walk.pub"});
  hil::VehicleSetup setup;
  setup.start = {.position = {Meters{12'500}, Meters{12'500}}, .depth = Meters{50}, .heading = Radians{0.0}, .speed = MetersPerSecond{0.0}};
  setup.source.snr = [](Meters) { return Decibels{0.0}; };
  setup.without = {"hydrophone", "operator"};
  launch(setup);

  const auto turn = [&] { payload.turn(Decibels{3.0}); };
  ASSERT_TRUE(sails_until([&] { return payload.state() == MissionState::kSearch; }, 30s, turn)) << earshotd_->output();
  ASSERT_TRUE(sails_until([&] { return payload.state() != MissionState::kSearch; }, 120s, turn)) << earshotd_->output();
  EXPECT_EQ(payload.state(), MissionState::kDone);
  EXPECT_EQ(payload.health.end_reason, static_cast<std::int8_t>(EndReason::kStepsUsedUp));
  EXPECT_EQ(payload.health.steps_taken, 6);
  ASSERT_TRUE(sails_until([&] { return has_surfaced(); }, 60s, turn)) << earshotd_->output();
  end();

  const Voyage voyage(folder_ / "journal.lcmlog");
  expect_replayed(6);
  expect_taken(voyage.setpoints);
  expect_surfaced(voyage.fixes);
  ASSERT_FALSE(voyage.answers.empty());
  EXPECT_EQ(voyage.answers.front(), CommandOutcome::kObeyed);
  // Fifty times as fast, a halt of 2 ms between two looks at the host's clocks dates a fix 100 ms late, and the next is older than that.
  EXPECT_LT(static_cast<double>(payload.health.navigation_refused), 0.02 * static_cast<double>(voyage.fixes.size()));
  EXPECT_EQ(bus_->lost(), 0U);
  // Six legs of 200 m; each ends within the vehicle's turning circle of 19 m, and its way on after the last is 2 m/s x 5 s.
  EXPECT_NEAR(vehicle_->sailed().value, 1'200.0, 6 * 19.0 + 10.0);
  std::cout << "sailed " << vehicle_->sailed().value << " m; " << voyage.fixes.size() << " fixes, " << voyage.setpoints.size()
            << " set-points, " << bus_->sent() << " frames\n";
}

}  // namespace
}  // namespace earshot
