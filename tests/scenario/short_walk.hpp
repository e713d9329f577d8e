#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "earshot/health_t.hpp"
#include "earshot/operator_command_t.hpp"
#include "earshot/snr_estimate_t.hpp"
#include "firmware/host/transport/lcm_endpoint.hpp"
#include "firmware/messages/health.hpp"
#include "tests/scenario/sea_over_can.hpp"
#include "tests/support/lcm_peer.hpp"

namespace earshot {

/// The payload's side of a mission whose vehicle alone is on CAN: a hydrophone and an operator on LCM.
class PayloadOverLcm {
 public:
  explicit PayloadOverLcm(const std::string& url) : endpoint_(host::parse_lcm_url(url), {wire::kHealthChannel}) {}

  /// Says what the hydrophone hears, and START until the search has begun.
  void turn(Decibels snr) {
    endpoint_.collect();
    for (wire::Lc02Message message; endpoint_.take(message) == Status::kOk;) {
      EXPECT_EQ(support::read_peer(message.data, health), Status::kOk);
      is_heard_ = true;
    }
    snr_estimate_t estimate{};
    estimate.utime = hil::ScaledClock::utc().us;
    estimate.snr_db = snr.value;
    EXPECT_EQ(endpoint_.publish(wire::kSnrEstimateChannel, support::bytes_of(estimate)), Status::kOk);
    if (is_heard_ && state() == messages::MissionState::kStandby) start();
  }

  [[nodiscard]] messages::MissionState state() const { return static_cast<messages::MissionState>(health.state); }
  health_t health{};

 private:
  void start() {
    operator_command_t order{};
    order.utime = hil::ScaledClock::utc().us;
    order.expiry_utime = order.utime + 10'000'000;
    order.issuer = 4711;
    order.number = 1;
    order.command = operator_command_t::START;
    EXPECT_EQ(endpoint_.publish(wire::kOperatorCommandChannel, support::bytes_of(order)), Status::kOk);
  }

  host::LcmEndpoint endpoint_;
  bool is_heard_ = false;
};

/// In steps of 200 m at a depth of 50 m, with a policy that walks at random.
class ShortWalk : public SeaOverCan {
 protected:
  ShortWalk() {
    policy::FrozenPolicy walk = support::random_walk_policy();
    walk.step_length = Meters{200};
    support::write_bytes(folder_ / "walk.policy", support::signed_bytes(walk));
    support::write_public_key(folder_ / "walk.pub");
  }
  [[nodiscard]] static std::string walk_in(const std::string& name, int steps = 6) {
    std::string mission = patient_mission(name);
    replace(mission, "step_length_m = 1000.0", "step_length_m = 200.0");
    replace(mission, "max_steps = 100", "max_steps = " + std::to_string(steps));
    replace(mission, "depth_m = 300.0", "depth_m = 50.0");
    replace(mission, "listening = \"mean\"", "listening = \"newest\"");
    replace(mission, "listening_window_s = 30", "listening_window_s = 0");
    return mission;
  }
  [[nodiscard]] std::vector<std::string> policy() const {
    return {"--policy", folder_ / "walk.policy", "--public-key", folder_ / "walk.pub"};
  }
  [[nodiscard]] static hil::VehicleSetup in_the_middle() {
    hil::VehicleSetup setup;
    setup.start = {.position = {Meters{12'500}, Meters{12'500}}, .depth = Meters{50}, .heading = {}, .speed = {}};
    setup.source = {.position = {Meters{0}, Meters{0}}, .snr = [](Meters) { return Decibels{3.0}; }};
    return setup;
  }
};

}  // namespace earshot
