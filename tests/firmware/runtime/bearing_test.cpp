// Bearings on their way to a decision.

#include <gtest/gtest.h>

#include <initializer_list>
#include <limits>
#include <memory>
#include <optional>

#include "tests/firmware/runtime/mission_rig.hpp"

namespace earshot::runtime {
namespace {

using messages::Bearing;
using messages::BearingMeasurement;

constexpr Bearing kBearing{.direction = Radians{1.0}, .deviation = Radians{0.2}, .mirror_axis = Radians{0.25}};

BearingMeasurement measured(Time time, double direction, std::uint32_t sender = 1) {
  return {.time = time, .bearing = {.direction = Radians{direction}, .deviation = Radians{0.2}}, .sender = sender};
}

config::Mission mission_that_hears(config::ListeningWindow window) {
  config::Mission mission = paper_mission();
  mission.listening = window;
  return mission;
}

std::unique_ptr<policy::FrozenPolicy> policy_that_hears(config::ListeningWindow window) {
  auto policy = policy_that_goes(kNorthward);
  policy->observation.listening = window;
  return policy;
}

constexpr config::ListeningWindow kHalfAMinute{.listening = config::Listening::kMean, .length = Duration::seconds(30)};

struct BearingRig : Rig {
  explicit BearingRig(config::ListeningWindow window = {}) : Rig(*policy_that_hears(window), mission_that_hears(window)) {}
  explicit BearingRig(const policy::FrozenPolicy& policy, const config::Mission& mission = paper_mission()) : Rig(policy, mission) {}

  /// One second passes with navigation and SNR as they should be, and bearings that arrive at its end.
  void sail_and_hear(std::initializer_list<BearingMeasurement> bearings, std::optional<Order> order = std::nullopt) {
    move();
    now = now + Duration::seconds(1);
    for (const BearingMeasurement& bearing : bearings) take(bearing);
    step_again({.navigation = navigation_at(now), .snr = messages::SnrMeasurement{.time = now, .snr = snr}, .order = order});
  }
  [[nodiscard]] Time in_a_second(Duration before = {}) const { return now + Duration{Duration::seconds(1).us - before.us}; }

  /// What the first decision heard, of a bearing measured so long before its measurement.
  std::optional<Bearing> heard_at_start(Duration before) {
    sail_and_hear({{.time = in_a_second(before), .bearing = kBearing}}, Order::kStart);
    return decided();
  }

  /// What the decision at the end of the leg heard, of a bearing measured so long before it.
  std::optional<Bearing> heard_on_leg(Duration before) {
    const Time end = now + Duration::seconds(kLeg_s);
    const Time measured = end + Duration{-before.us};
    while (now < end) {
      if (measured > now && measured <= in_a_second())
        sail_and_hear({{.time = measured, .bearing = kBearing}});
      else
        sail();
      EXPECT_EQ(outputs.decision.has_value(), now == end);
    }
    return decided();
  }

  [[nodiscard]] std::optional<Bearing> decided() const {
    EXPECT_TRUE(outputs.decision);
    return outputs.decision.value_or(messages::Decision{}).bearing;
  }
};

TEST(RuntimeBearing, IsHeardByADecisionWhenItIsLessThanASecondOlderThanTheNewestMeasurement) {
  EXPECT_EQ(BearingRig().heard_at_start(Duration::milliseconds(999)), kBearing);
  EXPECT_FALSE(BearingRig().heard_at_start(Duration::milliseconds(1000)));
  for (const bool is_there : {true, false}) {
    BearingRig rig;
    rig.sail(Order::kStart);
    EXPECT_EQ(rig.heard_on_leg(Duration::milliseconds(is_there ? 999 : 1000)).has_value(), is_there);
  }
}

TEST(RuntimeBearing, IsHeardOverTheWindowThatMeasurementsAreHeardOver) {
  for (const int before_s : {0, 25, 29, 30, 31}) {
    BearingRig rig(kHalfAMinute);
    rig.sail(Order::kStart);
    EXPECT_EQ(rig.heard_on_leg(Duration::seconds(before_s)).has_value(), before_s < 30) << before_s << " s before the decision";
  }
}

TEST(RuntimeBearing, OfTheStartBelongsToItsNewestMeasurementWhateverTheWindow) {
  EXPECT_TRUE(BearingRig(kHalfAMinute).heard_at_start(Duration::milliseconds(999)));
  EXPECT_FALSE(BearingRig(kHalfAMinute).heard_at_start(Duration::seconds(2)));
}

TEST(RuntimeBearing, IsNotHeardAgainByTheDecisionAfter) {
  constexpr config::ListeningWindow kTwoMinutes{.listening = config::Listening::kLoudest, .length = Duration::seconds(120)};
  config::Mission mission = mission_that_hears(kTwoMinutes);
  mission.step_length = Meters{100.0};  // sailed in 50 s
  auto policy = policy_that_hears(kTwoMinutes);
  policy->step_length = mission.step_length;
  BearingRig rig(*policy, mission);
  rig.sail(Order::kStart);
  rig.sail_and_hear({{.time = rig.in_a_second(), .bearing = kBearing}});
  ASSERT_TRUE(rig.sail_to_decision().decision);
  EXPECT_TRUE(rig.decided());
  ASSERT_TRUE(rig.sail_to_decision().decision);
  EXPECT_FALSE(rig.decided());
}

TEST(RuntimeBearing, ReachesTheBelief) {
  const auto mean_after = [](std::optional<double> direction) {
    BearingRig rig(*policy_that_believes());
    rig.snr = Decibels{24};
    if (direction)
      rig.sail_and_hear({measured(rig.in_a_second(), *direction)}, Order::kStart);
    else
      rig.sail(Order::kStart);
    return rig.outputs.decision->belief->mean;
  };
  const NorthEast without = mean_after(std::nullopt);
  // From 12 km north and 11 km east of the area's corner: a cone to an edge has its mean at two thirds of the way, 8 km from the middle.
  EXPECT_GT(mean_after(0.0).north - without.north, Meters{3'000.0});
  EXPECT_LT(mean_after(4.712).east - without.east, Meters{-3'000.0});
}

TEST(RuntimeBearing, RefusesAndCountsWhatIsNoAngleOrOldAndKeepsTheGoodOne) {
  BearingRig rig;
  const Time measurement = rig.in_a_second();
  const BearingMeasurement good = measured(measurement, 1.0);
  rig.sail_and_hear({good, measured(measurement, std::numeric_limits<double>::quiet_NaN()), measured(measurement, 7.0),
                     measured(measurement + Duration::seconds(-3600), 2.0), measured(measurement + Duration{-1}, 2.0)},
                    Order::kStart);
  EXPECT_EQ(rig.counters().bearings_refused, 4U);
  EXPECT_EQ(rig.counters().bearings_of_others, 0U);
  EXPECT_EQ(rig.counters().snr_refused, 0U);
  EXPECT_EQ(rig.decided(), good.bearing);
}

TEST(RuntimeBearing, RefusesWhatIsFurtherFromItsArrivalThanAnSnrMayBe) {
  BearingRig rig;
  const Duration timeout = paper_mission().snr_timeout;
  rig.sail_and_hear({measured(rig.in_a_second(Duration{timeout.us + 1}), 1.0)});
  EXPECT_EQ(rig.counters().bearings_refused, 1U);
  rig.sail_and_hear({measured(rig.in_a_second(timeout), 1.0)});
  EXPECT_EQ(rig.counters().bearings_refused, 1U);
}

TEST(RuntimeBearing, ListensToTheFirstOfTwoSendersAndCountsTheOther) {
  BearingRig rig;
  const Time measurement = rig.in_a_second();
  const BearingMeasurement first = measured(measurement, 1.0, 17);
  const BearingMeasurement other = measured(measurement, 3.0, 18);
  rig.sail_and_hear({first, other, other, other}, Order::kStart);
  EXPECT_EQ(rig.counters().bearings_of_others, 3U);
  EXPECT_EQ(rig.counters().bearings_refused, 0U);
  EXPECT_EQ(rig.decided(), first.bearing);
}

TEST(RuntimeBearing, IsNoSnr) {
  Rig rig(*policy_that_goes(kNorthward));
  for (int i = 0; i < 10; ++i) {
    rig.take(BearingMeasurement{.time = rig.now, .bearing = kBearing});
    rig.step({.navigation = rig.navigation_at(rig.now), .order = i == 0 ? std::optional(Order::kStart) : std::nullopt});
  }
  EXPECT_EQ(rig.state(), MissionState::kStandby) << "a search needs to know how loud";
}

}  // namespace
}  // namespace earshot::runtime
