// Over which window a decision listens.
#include <gtest/gtest.h>

#include "tests/firmware/runtime/mission_rig.hpp"

namespace earshot::runtime {
namespace {

using config::Listening;

constexpr config::ListeningWindow kLoudestOfFifteen{.listening = Listening::kLoudest, .length = Duration::seconds(15)};

config::Mission mission_that_listens(config::ListeningWindow window, Meters step_length = Meters{1000}) {
  config::Mission mission = paper_mission();
  mission.listening = window;
  mission.step_length = step_length;
  return mission;
}

/// Remembers two steps of (dx, dy, SNR).
std::unique_ptr<policy::FrozenPolicy> policy_that_listens(config::ListeningWindow window, Meters step_length = Meters{1000}) {
  auto policy = policy_that_goes(kNorthward);
  policy->observation.spec = policy::memory_state(2, step_length, Decibels{10}).value();
  policy->observation.listening = window;
  policy->step_length = step_length;
  tests::set_inputs(policy->network, policy->observation.spec.size());
  return policy;
}

struct ListeningRig : Rig {
  explicit ListeningRig(config::ListeningWindow window, Meters step_length = Meters{1000})
      : Rig(*policy_that_listens(window, step_length), mission_that_listens(window, step_length)) {}

  /// Sails to the next decision with `pulse` in place of the usual SNR once, so many seconds before the leg's end. @param leg_s  its length
  messages::Decision decision_after_pulse(int leg_s, int before_end_s, Decibels pulse) {
    const Decibels usual = snr;
    for (int s = 1; s <= leg_s; ++s) {
      snr = s == leg_s - before_end_s ? pulse : usual;
      sail();
      EXPECT_EQ(outputs.decision.has_value(), s == leg_s) << s;
    }
    snr = usual;
    return outputs.decision.value_or(messages::Decision{});
  }
};

TEST(Listening, DecidesByTheNewestMeasurementWhenTheMissionAsksForNoWindow) {
  ListeningRig rig({});
  rig.sail(Order::kStart);
  EXPECT_EQ(rig.decision_after_pulse(kLeg_s, 1, Decibels{30}).snr, Decibels{12});
  EXPECT_EQ(rig.decision_after_pulse(kLeg_s, 0, Decibels{30}).snr, Decibels{30});
}

TEST(Listening, DecidesByTheLoudestMeasurementOfTheWindowThatEndsTheLeg) {
  ListeningRig rig(kLoudestOfFifteen);
  rig.sail(Order::kStart);
  const messages::Decision heard = rig.decision_after_pulse(kLeg_s, 14, Decibels{30});
  EXPECT_EQ(heard.snr, Decibels{30});
  EXPECT_TRUE(heard.detected);
  EXPECT_FLOAT_EQ(heard.observation[2], 20.0F / 30.0F) << "the policy sees what is recorded: (30 - DT) / 30 dB";
  EXPECT_EQ(rig.decision_after_pulse(kLeg_s, 15, Decibels{30}).snr, Decibels{12}) << "one second too early";
}

TEST(Listening, HearsAPulseAmongMeasurementsThatAreTooFaintToMeasure) {
  ListeningRig rig(kLoudestOfFifteen);
  rig.sail(Order::kStart);
  for (int s = 1; s <= kLeg_s; ++s) {
    const Time measured = rig.now + Duration::seconds(1);
    rig.position = rig.position + at(2, 0);
    rig.step(
        {.navigation = rig.navigation_at(measured),
         .snr = messages::SnrMeasurement{.time = measured, .snr = Decibels{s == kLeg_s - 7 ? 8.0 : 3.0}, .too_faint = s != kLeg_s - 7}});
  }
  ASSERT_TRUE(rig.outputs.decision);
  EXPECT_EQ(rig.outputs.decision->snr, Decibels{8});
  EXPECT_FALSE(rig.outputs.decision->too_faint);
  EXPECT_FALSE(rig.outputs.decision->detected);  // measured, and below the threshold
}

TEST(Listening, NeverHearsWhatCameBeforeTheLeg) {
  constexpr config::ListeningWindow kLoudestOfTwoMinutes{.listening = Listening::kLoudest, .length = Duration::seconds(120)};
  ListeningRig rig(kLoudestOfTwoMinutes, Meters{200});
  constexpr int kShortLeg_s = 100;
  rig.snr = Decibels{40};
  for (int i = 0; i < 20; ++i) rig.sail();  // in standby
  rig.snr = Decibels{12};
  EXPECT_EQ(rig.sail(Order::kStart).decision.value_or(messages::Decision{}).snr, Decibels{12}) << "the start has one look";
  EXPECT_EQ(rig.decision_after_pulse(kShortLeg_s, 0, Decibels{30}).snr, Decibels{30});
  EXPECT_EQ(rig.decision_after_pulse(kShortLeg_s, kShortLeg_s - 1, Decibels{25}).snr, Decibels{25}) << "the leg's first look counts";
  EXPECT_EQ(rig.decision_after_pulse(kShortLeg_s, 0, Decibels{12}).snr, Decibels{12});
}

TEST(Configure, RefusesAPolicyTrainedToListenOverAnotherWindow) {
  EXPECT_EQ(ListeningRig(kLoudestOfFifteen).configured, Status::kOk);
  EXPECT_EQ(Rig(*policy_that_listens(kLoudestOfFifteen), mission_that_listens({})).configured, Status::kOutOfRange);
  EXPECT_EQ(Rig(*policy_that_listens({}), mission_that_listens(kLoudestOfFifteen)).configured, Status::kOutOfRange);
}

}  // namespace
}  // namespace earshot::runtime
