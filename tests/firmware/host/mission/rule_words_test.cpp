#include "firmware/host/mission/rule_words.hpp"

#include <gtest/gtest.h>

namespace earshot::host {
namespace {

using config::Condition;
using config::Response;
using config::Rule;

TEST(RuleWords, SayARuleAsAMissionFileDoes) {
  EXPECT_EQ(to_string(Rule{Condition::kBattery, 15.5, Duration::seconds(10), Response::kReturn, true}),
            "battery_percent below 15.5 for 10 s then return");
  EXPECT_EQ(to_string(Rule{Condition::kSearchTime, 1e7, {}, Response::kAbort, true}), "search_time_s above 10000000 then abort");
  EXPECT_EQ(to_string(Rule{Condition::kLeak, 0.0, {}, Response::kRelease, true}), "leak then release");
}

TEST(RuleWords, SayARuleAsAPersonDoesWithItsUnitAndItsKeyInBrackets) {
  EXPECT_EQ(sentence_of(Rule{Condition::kBattery, 15.5, Duration::seconds(10), Response::kReturn, true}),
            "return to the safe point once the battery's charge is below 15.5 % for 10 s (battery_percent), and until the mission ends");
  EXPECT_EQ(sentence_of(Rule{Condition::kTurnRate, 30, {}, Response::kWarn, false}),
            "warn once the rate of turn is above 30 degrees a second (turn_rate_deg_per_s)");
  EXPECT_EQ(sentence_of(Rule{Condition::kSpeed, 3, {}, Response::kSurface, false}),
            "surface once the speed through the water is above 3 m/s (speed_mps)");
  EXPECT_EQ(sentence_of(Rule{Condition::kHeadingIgnored, 60, {}, Response::kHold, false}),
            "hold the place once the angle between heading and set-point is above 60 degrees (heading_ignored_deg)");
  EXPECT_EQ(sentence_of(Rule{Condition::kDepth, 400, Duration::seconds(5), Response::kAbort, true}),
            "abort once the vehicle's depth is above 400 m for 5 s (depth_m)");
  EXPECT_EQ(sentence_of(Rule{Condition::kPlaceUnexplained, 0, Duration::seconds(10), Response::kAbort, true}),
            "abort once the place went further than speed, heading and current explain, by more than 0 m for 10 s (place_unexplained_m)");
  EXPECT_EQ(sentence_of(Rule{Condition::kNavigationDisputed, 60, {}, Response::kWarn, false}),
            "warn once late fixes lie more than 60 m from those believed of the same moment (navigation_disputed_m)");
  EXPECT_EQ(sentence_of(Rule{Condition::kLeak, 0, {}, Response::kRelease, true}),
            "abort and ask for the drop weight to be released once there is water in the hull (leak)");
}

}  // namespace
}  // namespace earshot::host
