#include "firmware/desk/replay_view/decision_table.hpp"

#include <gtest/gtest.h>

#include <array>
#include <sstream>
#include <string>

#include "firmware/messages/health.hpp"
#include "tests/firmware/desk/replay_view/known_decisions.hpp"
#include "tests/support/text/tells.hpp"

namespace earshot::replay_view {
namespace {

const std::vector<StepPair>& known_pairs() {
  static const std::array then{decision_to(0, 2, 13'000, 12'000), decision_to(1, 502.5, 12'000, 11'000)};
  static const std::array now{decision_to(0, 2, 13'000, 12'000), decision_to(1, 502.5, 11'000, 12'000),
                              decision_to(2, 900, 12'000, 13'000)};
  static const std::vector<StepPair> pairs = paired(then, now);
  return pairs;
}

TEST(DecisionTable, SaysWhereTheDecisionsPart) {
  EXPECT_TRUE(support::tells(where_they_part(known_pairs(), 0, kBegan),
                             {"step 1", "then", "502.5 s", "270 deg", "12.000 km north", "11.000 km east", "now", "502.5 s", "180 deg",
                              "11.000 km north", "12.000 km east"}));
  EXPECT_TRUE(support::tells(where_they_part(std::span(known_pairs()).first(1), 0, kBegan), {"not part", "1 step", "step 0", "same"}));
  EXPECT_TRUE(support::tells(where_they_part(std::span(known_pairs()).last(1), 0, kBegan),
                             {"step 2", "then not", "now", "900.0 s", "090 deg", "12.000 km north", "13.000 km east"}));
  EXPECT_EQ(where_they_part({}, 0, kBegan), "no decision, then or now");
}

TEST(DecisionTable, HasARowForEveryStepWithItsHalvesInColumns) {
  const std::string table = decision_table(known_pairs(), 0, kBegan);
  EXPECT_NE(table.find("\n    0     2.0   15.5 det.  000  13.000  12.000 |     2.0   15.5 det.  000  13.000  12.000\n"), std::string::npos)
      << table;
  EXPECT_NE(table.find("270  12.000  11.000 |   502.5   15.5 det.  180  11.000  12.000  parts\n"), std::string::npos) << table;
  EXPECT_TRUE(support::has_line(table, {"not", "900.0", "15.5", "det.  090", "12.000", "13.000", "differs"})) << table;
}

TEST(DecisionTable, FitsATerminalWhateverTheDecisionsAre) {
  messages::Decision late = decision_to(99, 123'456.5, -25'000, -25'000);
  late.too_faint = true;
  late.snr = Decibels{-20.0};
  const std::array then{late};
  late.waypoint.east = Meters{125'000};
  const std::array now{late};
  std::istringstream lines(decision_table(paired(then, now), 0, kBegan));
  for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 100U) << line;
}

TEST(DecisionTable, ListedFromALaterStepOnStillSaysWhereTheyPart) {
  EXPECT_TRUE(support::tells(where_they_part(known_pairs(), 2, kBegan), {"step 1", "before step 2", "then", "502.5 s", "270 deg"}));
  const std::string table = decision_table(known_pairs(), 2, kBegan);
  EXPECT_EQ(table.find("502.5"), std::string::npos) << table;
  EXPECT_TRUE(table.ends_with("  differs\n")) << table;
}

TEST(DecisionTable, SaysHowBothStoodWhereARecordIsMissing) {
  Counterfactual counterfactual;
  EXPECT_EQ(what_it_means(counterfactual, {}).find("at the journal's end, then: "), 0U);
  counterfactual.gap = 12782;
  EXPECT_EQ(what_it_means(counterfactual, {}).find("where record 12782 is missing, then: "), 0U);
}

TEST(DecisionTable, NamesTheRuleThatSteersAndTheOneThatEndsIt) {
  Counterfactual counterfactual;
  counterfactual.began = kBegan;
  messages::SafetyEvent rule{
      .time = kBegan, .rule = 16, .condition = config::Condition::kBattery, .begins = true, .measure = 14.9, .limit = 15};
  rule.response = config::Response::kReturn;
  counterfactual.steering = {.time = kBegan, .fields = {}, .rules = {rule}};
  rule.response = config::Response::kAbort;
  counterfactual.now_ended.since = kBegan + Duration::seconds(7);
  counterfactual.now_ended.rule = rule;
  counterfactual.now_ended.health.state = messages::MissionState::kAbort;
  counterfactual.now_ended.health.end_reason = messages::EndReason::kSafetyRule;
  const std::string text = what_it_means(counterfactual, {});
  EXPECT_TRUE(support::has_line(text, {"now steers there", "rule 17", "battery_percent", "14.9", "below 15.0", "return"})) << text;
  EXPECT_TRUE(support::has_line(text, {"after 0 steps", "7.0 s", "rule 17", "battery_percent", "14.9", "below 15.0", "abort"})) << text;
}

TEST(DecisionTable, SaysThatItIsNoForecastOnlyWhereSomethingDiffers) {
  Counterfactual counterfactual;
  counterfactual.began = kBegan;
  const auto same = std::span(known_pairs()).first(1);
  EXPECT_EQ(what_it_means(counterfactual, same).find("no forecast"), std::string::npos);
  EXPECT_NE(what_it_means(counterfactual, known_pairs()).find("no forecast"), std::string::npos);
  counterfactual.steering = {.time = kBegan + Duration::seconds(3), .fields = {{.field = "depth_m", .then = "300.0", .now = "250.0"}}};
  EXPECT_TRUE(support::has_line(what_it_means(counterfactual, same), {"3.0 s", "depth_m", "300.0", "250.0 now"}));
  EXPECT_NE(what_it_means(counterfactual, same).find("no forecast"), std::string::npos);
}

}  // namespace
}  // namespace earshot::replay_view
