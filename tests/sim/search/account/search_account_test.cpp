#include "sim/search/account/search_account.hpp"

#include <gtest/gtest.h>

namespace earshot::search {
namespace {

TEST(SearchSentences, GiveMismatchSweepAndDeclarationOnceEach) {
  const nlohmann::json summary{{"surprise_bits", 13.25},   {"surprised_from_step", 9U},
                               {"swept_from_step", 11U},   {"max_steps", 100U},
                               {"step_length_m", 1'000.0}, {"declared_found", {{"step", 34U}, {"range_m", 1'020.6}}}};
  ASSERT_EQ(fault_in_account(summary), "");
  EXPECT_EQ(
      to_string(account_in(summary)),
      "From step 9 on, the SNR that it measured was unlikely in every ocean of its tables (model-mismatch score 13.2 bits at the end; "
      "from 6.75 on it is a mismatch). From step 11 of 100 on it swept the whole area in parallel tracks: the SNR that it measured "
      "fits no ocean of its tables. The vehicle declared the source found at step 34, wrongly: 1021 m from the source.");
}

TEST(SearchSentences, GiveTheScoreBesideTheOneFromWhichItIsAMismatch) {
  EXPECT_EQ(to_string({.believes = true, .mismatch_bits = -19.04}),
            "The SNR that it measured fits the oceans of its tables (model-mismatch score -19.0 bits at the end; from 6.75 on it is a "
            "mismatch).");
}

TEST(SearchSentences, ExplainASweepBeforeAnyMismatchByTheMissingDetections) {
  EXPECT_EQ(
      to_string({.believes = true, .mismatch_bits = -9.0, .sweep_step = 43, .max_steps = 100}),
      "The SNR that it measured fits the oceans of its tables, but there were too few detections: the source may be fainter or silent for "
      "longer than expected, or not there (model-mismatch score -9.0 bits at the end; from 6.75 on it is a mismatch). From step 43 of 100 "
      "on it swept the whole area in parallel tracks: it had detected nothing "
      "for long, where its tables predict detections.");
  const SearchAccount mismatch_later{.believes = true, .mismatch_bits = 7.0, .mismatch_step = 44, .sweep_step = 43};
  EXPECT_TRUE(mismatch_later.swept_in_silence());
  const SearchAccount mismatch{.believes = true, .mismatch_bits = 13.0, .mismatch_step = 43, .sweep_step = 43};
  EXPECT_FALSE(mismatch.swept_in_silence());
}

TEST(SearchSentences, StateOfAVehicleThatCameNearTheSourceThatItHadNotDeclaredIt) {
  const std::string undeclared =
      "The vehicle's own rule had not reported the source found by then. The simulation ends here; at sea the search would go on.";
  EXPECT_NE(to_string(account_in({{"found", true}, {"surprise_bits", 1.0}, {"declared_found", nullptr}})).find(undeclared),
            std::string::npos);
  EXPECT_EQ(to_string(account_in({{"found", true}, {"surprise_bits", nullptr}})), "") << "a policy without a belief declares nothing";
}

TEST(SearchSentences, CallADeclarationWrongFromMoreThanAStepLengthOn) {
  EXPECT_EQ(to_string({.declared_step = 7, .declared_range_m = 1'000.0, .step_length_m = 1'000.0}),
            "The vehicle declared the source found at step 7: 1000 m from the source.");
  EXPECT_EQ(to_string({.declared_step = 7, .declared_range_m = 1'001.0, .step_length_m = 1'000.0}),
            "The vehicle declared the source found at step 7, wrongly: 1001 m from the source.");
  EXPECT_EQ(to_string({.declared_step = 7}), "The vehicle declared the source found at step 7.")
      << "at sea nobody knows where the source was";
}

TEST(SearchSentences, GiveTheRuleThatSentTheVehicleHomeAndWhen) {
  nlohmann::json summary{{"went_home", {{"step", 1U}, {"what", "rule 15, battery_at_home_percent: 14.9, below 15.0: return"}}}};
  ASSERT_EQ(fault_in_account(summary), "");
  EXPECT_EQ(to_string(account_in(summary)),
            "After 1 step a safety rule sent the vehicle home: rule 15, battery_at_home_percent: 14.9, below 15.0: return.");
  EXPECT_EQ(sentences(account_in(summary)).at(0).label, "went home");
  summary["went_home"] = {{"step", 0U}, {"what", "rule 16, battery_percent: 9.9, below 10.0: surface"}, {"response", "surface"}};
  EXPECT_EQ(to_string(account_in(summary)),
            "After 0 steps a safety rule sent the vehicle to the surface: rule 16, battery_percent: 9.9, below 10.0: surface.");
  EXPECT_EQ(sentences(account_in(summary)).at(0).label, "came up");
}

TEST(SearchSentences, AreNoneForASummaryOfAnEarlierVersionOrAPolicyWithoutABelief) {
  EXPECT_EQ(to_string(account_in({{"found", false}})), "");
  EXPECT_EQ(to_string(account_in({{"surprise_bits", nullptr}, {"declared_found", nullptr}})), "");
}

TEST(SearchSentences, RefuseWhatIsNoStepNoNumberNoRuleAndNoDeclaration) {
  EXPECT_EQ(fault_in_account({{"surprise_bits", "much"}}), "surprise_bits: must be a number");
  EXPECT_EQ(fault_in_account({{"swept_from_step", -1}}), "swept_from_step: must be a whole number, 0 to 1000000000");
  EXPECT_EQ(fault_in_account({{"ended_by", {{"what", 3}}}}), "ended_by: must be what, rule");
  EXPECT_EQ(fault_in_account({{"declared_found", {{"step", 3}}}}), "declared_found: must be step, range_m");
  EXPECT_EQ(fault_in_account({{"went_home", {{"step", 3U}, {"what", 15}}}}), "went_home: must be step, what");
  EXPECT_EQ(fault_in_account({{"went_home", true}}), "went_home: must be step, what");
}

/// Of 100 steps of 1 km.
SearchAccount flown(std::string end_reason) {
  return {.max_steps = 100, .step_length_m = 1'000.0, .steps = 100, .end_reason = std::move(end_reason)};
}

TEST(Verdict, CountsTheStepsToASourceThatTheVehicleCameNear) {
  SearchAccount account = flown("completed");
  account.is_found = true;
  account.steps = 18;
  EXPECT_TRUE(verdict_on(account).is_found);
  EXPECT_EQ(verdict_on(account).text, "Source found after 18 steps: the vehicle came within 1.0 km of it");
  account.steps = 1;
  account.step_length_m = std::nullopt;
  EXPECT_EQ(verdict_on(account).text, "Source found after 1 step: the vehicle came within one step length of it");
}

TEST(Verdict, NeverDeniesASourceThatTheVehicleRightlyDeclaredFound) {
  SearchAccount account = flown("steps_used_up");
  account.declared_step = 10;
  account.declared_range_m = 640.0;
  EXPECT_TRUE(verdict_on(account).is_found);
  EXPECT_EQ(verdict_on(account).text, "Source found: the vehicle declared it found at step 10, 640 m from it");
}

TEST(Verdict, StatesThatADeclarationWasWrongInTheSentenceThatDeniesTheSource) {
  SearchAccount account = flown("steps_used_up");
  account.declared_step = 10;
  account.declared_range_m = 3'021.4;
  EXPECT_FALSE(verdict_on(account).is_found);
  EXPECT_EQ(verdict_on(account).text, "Source not found in 100 steps: the vehicle declared it found at step 10, wrongly, 3021 m from it");
}

TEST(Verdict, StatesWhyASearchWithoutTheSourceEndedOrWasLost) {
  EXPECT_EQ(verdict_on(flown("steps_used_up")).text, "Source not found in 100 steps: all 100 steps were taken");
  EXPECT_EQ(verdict_on(flown("time_used_up")).text, "Source not found in 100 steps: time used up");
  EXPECT_EQ(verdict_on(flown("bus_lost")).text, "The flight was lost after 100 steps: a set-point did not arrive over the bus");
  SearchAccount ended = flown("safety_rule");
  ended.ending_rule = "rule 10, battery_percent: 29.998, below 30.000: abort";
  EXPECT_EQ(verdict_on(ended).text, "Source not found in 100 steps: safety rule 10, battery_percent: 29.998, below 30.000: abort");
  ended.end_reason = "navigation_stale";
  EXPECT_EQ(end_to_string(ended), "navigation stale: safety rule 10, battery_percent: 29.998, below 30.000: abort");
}

TEST(SearchAccount, ReadsTheCodesThatASummaryOfAnEarlierVersionHasForItsEnd) {
  EXPECT_EQ(end_to_string(account_in({{"found", false}, {"end_reason", "found"}})), "the vehicle declared the source found");
  EXPECT_EQ(end_to_string(account_in({{"found", false}, {"end_reason", "declared_found"}})), "the vehicle declared the source found");
  const std::string reached = "the vehicle came within one step length of the source";
  EXPECT_EQ(end_to_string(account_in({{"found", true}, {"end_reason", "completed"}})), reached);
  EXPECT_EQ(end_to_string(account_in({{"found", true}, {"end_reason", "found"}})), reached);
}

TEST(Meanings, GiveTheSouthWestCornerWhereItIsTheOriginAndElseWhatTheOriginIs) {
  nlohmann::json summary{{"origin", {{"latitude_deg", 38.5}, {"longitude_deg", -28.0}}},
                         {"area", {{"south_west", {{"north_m", 0.0}, {"east_m", 0.0}}}}}};
  EXPECT_EQ(place_of_area(summary, ""), "its south-west corner lies at 38.500 N, 28.000 W");
  summary["area"]["south_west"]["east_m"] = -500.0;
  EXPECT_EQ(place_of_area(summary, ""), "the place from which metres north and east count lies at 38.500 N, 28.000 W");
  EXPECT_EQ(place_of_area({{"origin", nullptr}}, ""), "");
}

TEST(Meanings, NameTheThresholdAndTheStepLength) {
  EXPECT_EQ(detection_means(10.0), "a step that ends with an SNR of 10 dB or more");
  EXPECT_EQ(found_means(1'000.0), "the vehicle came within one step length of the source, 1.0 km");
  EXPECT_EQ(found_means(std::nullopt), "the vehicle came within one step length of the source");
}

}  // namespace
}  // namespace earshot::search
