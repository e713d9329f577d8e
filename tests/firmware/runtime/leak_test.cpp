#include <gtest/gtest.h>

#include "tests/firmware/runtime/mission_rig.hpp"

namespace earshot::runtime {
namespace {

config::Mission that_releases_on_a_leak() {
  config::Mission mission = paper_mission();
  EXPECT_EQ(mission.safety.rules.push_back({.condition = config::Condition::kLeak,
                                            .limit = 0,
                                            .persistence = Duration::seconds(2),
                                            .response = config::Response::kRelease,
                                            .is_latched = true}),
            Status::kOk);
  return mission;
}

/// What a vehicle's computers say of its hull, in turn; one knows nothing of it.
void publish_hull(Rig& rig, std::uint8_t port, bool has_leak, Duration dated) {
  const messages::VehicleStatus status{.time = rig.now + dated, .battery_percent = 80.0, .has_leak = has_leak};
  rig.runtime->take({.arrival = rig.now, .port = port, .sequence = rig.sequence++, .value = status});
}

TEST(Leak, DropsItsWeightThoughASecondSenderOfThePortSaysThatThereIsNoLeak) {
  for (const int ahead_ms : {0, 400}) {
    Rig rig = under_way(that_releases_on_a_leak());
    for (int i = 0; i < 6; ++i) {
      publish_hull(rig, 1, true, Duration{});
      publish_hull(rig, 1, false, Duration::milliseconds(ahead_ms));
      rig.sail();
    }
    EXPECT_TRUE(rig.setpoint.release_weight) << "a clock " << ahead_ms << " ms ahead";
  }
}

TEST(Leak, DropsItsWeightOnALeakThatWasToldOnceThoughAnotherPortKnowsOfNone) {
  Rig rig = under_way(that_releases_on_a_leak());
  publish_hull(rig, 2, true, Duration{});
  for (int i = 0; i < 4; ++i) {
    publish_hull(rig, 1, false, Duration{});
    rig.sail();
  }
  EXPECT_TRUE(rig.setpoint.release_weight);
}

TEST(Leak, KeepsItsWeightForADropOnASensor) {
  Rig rig = under_way(that_releases_on_a_leak());
  publish_hull(rig, 1, true, Duration{});
  rig.sail();
  for (int i = 0; i < 6; ++i) {
    publish_hull(rig, 1, false, Duration{});
    rig.sail();
  }
  EXPECT_FALSE(rig.setpoint.release_weight);
  EXPECT_EQ(rig.state(), MissionState::kSearch);
}

// As whoever rinses the vehicle on deck makes it tell.
TEST(Leak, OfBeforeTheSearchIsForgottenOnceItIsTakenBack) {
  Rig rig(*policy_that_goes(kNorthward), that_releases_on_a_leak());
  for (const bool has_leak : {true, false, true, false}) {
    publish_hull(rig, 1, has_leak, Duration{});
    rig.sail();
  }
  rig.sail(Order::kStart);
  for (int i = 0; i < 6; ++i) {
    publish_hull(rig, 1, false, Duration{});
    rig.sail();
  }
  EXPECT_EQ(rig.state(), MissionState::kSearch);
  EXPECT_FALSE(rig.setpoint.release_weight);
}

}  // namespace
}  // namespace earshot::runtime
