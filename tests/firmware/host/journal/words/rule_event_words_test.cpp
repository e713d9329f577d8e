#include "firmware/host/journal/words/rule_event_words.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace earshot::journal {
namespace {

messages::SafetyEvent event_of(config::Condition condition, config::Response response) {
  return {.time = {}, .condition = condition, .response = response};
}

TEST(RuleEventWords, SayARuleWithItsEvidence) {
  messages::SafetyEvent event = event_of(config::Condition::kBattery, config::Response::kReturn);
  event.rule = 10;
  event.measure = 14.94;
  event.limit = 15;
  EXPECT_EQ(to_string(event), "rule 11, battery_percent: 14.9, below 15.0: return");
  event.begins = false;
  EXPECT_EQ(to_string(event), "rule 11, battery_percent: no longer");
  event = event_of(config::Condition::kLeak, config::Response::kRelease);
  EXPECT_EQ(to_string(event), "rule 1, leak: release");
  event.condition = static_cast<config::Condition>(config::kConditions);
  EXPECT_EQ(to_string(event), "rule 1, which this program does not know");
  event = event_of(config::Condition::kLeak, static_cast<config::Response>(config::kResponses));
  EXPECT_EQ(to_string(event), "rule 1, which this program does not know");
}

TEST(RuleEventWords, TellAMeasureFromItsLimitHoweverNearItIs) {
  messages::SafetyEvent event = event_of(config::Condition::kBattery, config::Response::kAbort);
  event.rule = 9;
  event.measure = 29.9977;
  event.limit = 30.0;
  EXPECT_EQ(to_string(event), "rule 10, battery_percent: 29.998, below 30.000: abort");
  event = event_of(config::Condition::kDepth, config::Response::kAbort);
  event.measure = 320.04;
  event.limit = 320.0;
  EXPECT_EQ(to_string(event), "rule 1, depth_m: 320.04, above 320.00: abort");
}

messages::SafetyEvent aborts_by(std::uint8_t rule, config::Condition condition, double measure, double limit) {
  messages::SafetyEvent event = event_of(condition, config::Response::kAbort);
  event.rule = rule;
  event.measure = measure;
  event.limit = limit;
  return event;
}

TEST(RuleEventWords, SayWhatAMeasureMeansThatANumberAloneDoesNot) {
  using config::Condition;
  EXPECT_EQ(to_string(aborts_by(9, Condition::kNavigationDisputed, 40.0, 0.0)),
            "rule 10, navigation_disputed_m: late fixes lie 40.0 m from those believed of their time: abort; two senders give places "
            "(earshot journal --jsonl has the ports)");
  EXPECT_EQ(to_string(aborts_by(10, Condition::kPlaceUnexplained, 7.5, 0.0)),
            "rule 11, place_unexplained_m: the place went 7.5 m further than speed, heading, current and their errors explain: abort; "
            "check navigation, log and compass");
  EXPECT_EQ(to_string(aborts_by(11, Condition::kDepthUnexplained, 275.0, 0.0)),
            "rule 12, depth_unexplained_m: the depth is 275.0 m further from its set-points than it may be: abort; check the depth "
            "sensor and whether the autopilot obeys");
  EXPECT_EQ(to_string(aborts_by(12, Condition::kSetpointsUnsent, 10.2, 10.0)),
            "rule 13, setpoints_unsent_s: no set-point could be sent for 10.2 s, above 10.0: abort; check the port's bus and its "
            "address");
}

TEST(RuleEventWords, NeedNoMoreDecimalsThanThereAreToTellNumbersApart) {
  EXPECT_EQ(decimals_apart(14.9, 15.0), 1);
  EXPECT_EQ(decimals_apart(15.0, 15.0), 1);
  EXPECT_EQ(decimals_apart(15.0 + 1e-12, 15.0), 6) << "no number of decimals does";
  EXPECT_EQ(decimals_apart(std::numeric_limits<double>::quiet_NaN(), 15.0), 1);
  EXPECT_EQ(decimals_apart(1e300, 15.0), 1);
}

}  // namespace
}  // namespace earshot::journal
