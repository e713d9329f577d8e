#include "hil/bench/disarmed.hpp"

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

namespace earshot::hil {
namespace {

using config::Condition;

constexpr const char* kMissionText = R"(step_period_s = 1.0

[limits]
navigation_timeout_s = 5.0  # of a fix
snr_timeout_s = 5.0

[[rule]]
when = "leak"
for_s = 2.0
then = "release"

[[rule]]
when = "battery_percent"
below = 20.0
then = "surface"

[policy]
file = "../policy/a.policy"
public_key_file = "/keys/a.pub"
tables = "../tables"
)";

TEST(Disarmed, LeavesOutTheRulesOfTheMissionAndNoOther) {
  const std::string text = disarmed(kMissionText, {Condition::kLeak}, "/missions");
  EXPECT_EQ(text.find("leak"), std::string::npos) << text;
  EXPECT_EQ(text.find("release"), std::string::npos) << text;
  EXPECT_NE(text.find("[[rule]]\nwhen = \"battery_percent\"\nbelow = 20.0\nthen = \"surface\"\n"), std::string::npos) << text;
  EXPECT_NE(text.find("snr_timeout_s = 5.0\n"), std::string::npos) << text;
}

TEST(Disarmed, PutsOffTheRulesOfEveryMissionByTheirLimit) {
  const std::string text = disarmed(kMissionText, {Condition::kNavigationAge}, "/missions");
  EXPECT_NE(text.find("navigation_timeout_s = 60.0\n"), std::string::npos) << text;
  EXPECT_NE(text.find("snr_timeout_s = 5.0\n"), std::string::npos) << text;
  EXPECT_NE(text.find("\"leak\""), std::string::npos) << text;
}

TEST(Disarmed, NamesFilesWithTheirWholePaths) {
  const std::string text = disarmed(kMissionText, {}, "/missions/at_sea");
  EXPECT_NE(text.find("file = \"/missions/policy/a.policy\"\n"), std::string::npos) << text;
  EXPECT_NE(text.find("public_key_file = \"/keys/a.pub\"\n"), std::string::npos) << text;
  EXPECT_NE(text.find("tables = \"/missions/tables\"\n"), std::string::npos) << text;
}

TEST(Disarmed, CannotDoWithoutWhatNoMissionCanPutOff) {
  EXPECT_FALSE(can_be_disarmed(Condition::kNoProgress));
  EXPECT_FALSE(can_be_disarmed(Condition::kNavigationJump));
  EXPECT_TRUE(can_be_disarmed(Condition::kLeak));
  EXPECT_TRUE(can_be_disarmed(Condition::kSnrAge));
}

/// A mission that is released by a leak, and warned of a ground fault.
config::Mission mission_with_rules() {
  config::Mission mission;
  (void)mission.safety.rules.push_back({.condition = Condition::kLeak, .persistence = {}, .response = config::Response::kRelease});
  (void)mission.safety.rules.push_back({.condition = Condition::kGroundFault, .persistence = {}, .response = config::Response::kWarn});
  return mission;
}

Expectation expectation(std::vector<Condition> rules) {
  return {.end = messages::EndReason::kSafetyRule, .rules = std::move(rules), .releases_weight = true};
}

TEST(ExpectedWithoutFiring, IsWhatARuleDoesForARuleThatIsNotThereCannotFire) {
  const Expectation left = expected_without_firing(expectation({Condition::kLeak}), {Condition::kLeak}, mission_with_rules());
  EXPECT_EQ(left.end, messages::EndReason::kSafetyRule);
  EXPECT_TRUE(left.releases_weight);
  EXPECT_TRUE(left.rules.empty());
  EXPECT_FALSE(left.only_these);
}

TEST(ExpectedWithoutFiring, IsTheFiringOfRulesThatDoNothingButWarn) {
  const Expectation whole = expectation({Condition::kGroundFault});
  EXPECT_EQ(expected_without_firing(whole, whole.rules, mission_with_rules()), whole);
}

TEST(ExpectedWithoutFiring, KnowsTheRulesThatNoMissionSwitchesOff) {
  const Expectation left =
      expected_without_firing(expectation({Condition::kNavigationAge}), {Condition::kNavigationAge}, mission_with_rules());
  EXPECT_TRUE(left.rules.empty());
}

}  // namespace
}  // namespace earshot::hil
