#include "sim/apps/fly/search_account.hpp"

#include <gtest/gtest.h>

#include "tests/support/text/tells.hpp"

namespace earshot::fly {
namespace {

constexpr NorthEast kSomewhere{Meters{1'000.0}, Meters{2'000.0}};

/// Of 100 steps of 1 km, which were all taken.
nlohmann::json summary_with(const SearchAccount& account) {
  nlohmann::json s{{"found", false}, {"end_reason", "steps_used_up"}, {"steps", 100}, {"max_steps", 100}, {"step_length_m", 1'000.0}};
  s.update(nlohmann::json(account.to_json()));
  return s;
}

TEST(SearchAccount, NotesFromWhichStepOnASearchWasAMismatchAndSweptAndWithWhichScoreItEnded) {
  SearchAccount account;
  account.note({.steps_taken = 8, .believed_source = kSomewhere, .mismatch_bits = 6.7F}, Meters{9'000.0});
  account.note({.steps_taken = 9, .believed_source = kSomewhere, .mismatch_bits = 6.75F}, Meters{9'000.0});
  account.note({.steps_taken = 11, .believed_source = kSomewhere, .mismatch_bits = 12.0F, .is_sweeping = true}, Meters{9'000.0});
  account.note({.steps_taken = 100, .believed_source = kSomewhere, .mismatch_bits = 13.25F, .is_sweeping = true}, Meters{9'000.0});
  EXPECT_EQ(account.to_json().dump(), R"({"surprise_bits":13.25,"surprised_from_step":9,"swept_from_step":11,"declared_found":null})");
  EXPECT_TRUE(support::lines_tell(
      account_lines(summary_with(account)),
      {{"step 9", "SNR"}, {"13.2 bits", "6.75"}, {"sweep", "step 11", "100", "swept", "tracks", "SNR"}, {"measured", "fits", "no ocean"}}));
}

TEST(SearchAccount, GivesTheLastScoreOfASearchThatWasAMismatchBefore) {
  SearchAccount account;
  account.note({.steps_taken = 8, .believed_source = kSomewhere, .mismatch_bits = 9.0F}, Meters{9'000.0});
  account.note({.steps_taken = 9, .believed_source = kSomewhere, .mismatch_bits = 2.5F}, Meters{9'000.0});
  EXPECT_EQ(account.to_json().dump(), R"({"surprise_bits":2.5,"surprised_from_step":8,"swept_from_step":null,"declared_found":null})");
  account.note({.steps_taken = 10, .mismatch_bits = 2.0F}, Meters{9'000.0});  // an answer that names no place
  EXPECT_EQ(account.to_json()["surprise_bits"], 2.0);
}

TEST(SearchAccount, GivesNoScoreWhereThePolicyHoldsNoBelief) {
  SearchAccount account;
  account.note({.steps_taken = 3}, Meters{9'000.0});
  EXPECT_EQ(account.to_json().dump(), R"({"surprise_bits":null,"surprised_from_step":null,"swept_from_step":null,"declared_found":null})");
  EXPECT_EQ(account_lines(summary_with(account)), "");
  EXPECT_EQ(account_lines({{"found", true}}), "") << "a summary of an earlier version";
}

TEST(SearchAccount, SaysHowFarFromTheSourceItDeclaredItFoundFirstAndWhetherWrongly) {
  SearchAccount account;
  account.note({.steps_taken = 34, .is_found = true}, Meters{1'020.6});
  account.note({.steps_taken = 35, .is_found = true}, Meters{400.0});
  nlohmann::json s = summary_with(account);
  EXPECT_TRUE(support::lines_tell(account_lines(s), {{"declared", "declared", "found", "step 34", "wrongly", "1021 m"}}));
}

TEST(SearchAccount, SaysWhatIsLeftOfTheBatteryAndWhatWasHeardInLinesThatATerminalHolds) {
  const std::string lines =
      account_lines({{"found", false},
                     {"battery_percent", 41.26},
                     {"hearing", {{"sound", "synthetic"}, {"looks", 123456}, {"looks_too_faint", 23456}, {"search_began_s", 120.4}}}});
  EXPECT_TRUE(support::lines_tell(
      lines,
      {{"battery", "41.3 %", "left"}, {"heard", "sound", "123456 SNRs", "23456", "too faint", "120 s"}, {"rest", "learn", "noise"}}));
}

TEST(SearchAccount, SaysWhichSafetyRuleEndedAFlightAndOnWhatEvidence) {
  const messages::SafetyEvent rule{.time = {},
                                   .rule = 9,
                                   .condition = config::Condition::kBattery,
                                   .response = config::Response::kAbort,
                                   .measure = 29.998,
                                   .limit = 30.0};
  EXPECT_EQ(ending_rule_to_json(rule).dump(),
            R"({"what":"rule 10, battery_percent: 29.998, below 30.000: abort","rule":10,"condition":"battery_percent","value":29.998,)"
            R"("limit":30.0,"response":"abort"})");
  EXPECT_TRUE(ending_rule_to_json(std::nullopt).is_null());
}

TEST(SearchAccount, SaysWhichRuleSentTheVehicleHomeFirstAndWhen) {
  const auto rule = [](std::uint8_t number, config::Response response) {
    return messages::SafetyEvent{
        .time = {}, .rule = number, .condition = config::Condition::kBatteryAtHome, .response = response, .measure = 14.94, .limit = 15.0};
  };
  SearchAccount account;
  account.note({.steps_taken = 0}, Meters{9'000.0});
  account.note({.steps_taken = 0, .rule = rule(14, config::Response::kReturn)}, Meters{9'000.0});
  account.note({.steps_taken = 1, .rule = rule(15, config::Response::kSurface)}, Meters{9'000.0});
  EXPECT_TRUE(
      support::lines_tell(account_lines(summary_with(account)),
                          {{"home", "After", "0 steps", "home", "rule 15", "battery_at_home_percent"}, {"14.9", "below 15.0", "return"}}));
  EXPECT_EQ(account.to_json().at("went_home").at("rule"), 15);
  SearchAccount aborted;
  aborted.note({.steps_taken = 3, .rule = rule(14, config::Response::kAbort)}, Meters{9'000.0});
  EXPECT_FALSE(aborted.to_json().contains("went_home")) << "it ended the search";
}

}  // namespace
}  // namespace earshot::fly
