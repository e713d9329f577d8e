#include "sim/apps/fly/search_account.hpp"

#include <gtest/gtest.h>

namespace earshot::fly {
namespace {

constexpr NorthEast kSomewhere{Meters{1'000.0}, Meters{2'000.0}};

/// Of 100 steps of 1 km, which were all taken.
nlohmann::json summary_with(const SearchAccount& account) {
  nlohmann::json s{{"found", false}, {"end_reason", "steps_used_up"}, {"steps", 100}, {"max_steps", 100}, {"step_length_m", 1'000.0}};
  s.update(nlohmann::json(account.to_json()));
  return s;
}

TEST(SearchAccount, SaysFromWhichStepOnASearchWasSurprisedAndSweptAndHowSurprisedItEnded) {
  SearchAccount account;
  account.note({.steps_taken = 8, .believed_source = kSomewhere, .surprise_bits = 6.7F}, Meters{9'000.0});
  account.note({.steps_taken = 9, .believed_source = kSomewhere, .surprise_bits = 6.75F}, Meters{9'000.0});
  account.note({.steps_taken = 11, .believed_source = kSomewhere, .surprise_bits = 12.0F, .is_sweeping = true}, Meters{9'000.0});
  account.note({.steps_taken = 100, .believed_source = kSomewhere, .surprise_bits = 13.25F, .is_sweeping = true}, Meters{9'000.0});
  EXPECT_EQ(account.to_json().dump(), R"({"surprise_bits":13.25,"surprised_from_step":9,"swept_from_step":11,"declared_found":null})");
  EXPECT_EQ(outcome(summary_with(account)), "source not found: all 100 steps taken");
  EXPECT_EQ(account_lines(summary_with(account)),
            "  surprise    from step 9 on what it heard was unlikely in every ocean of its tables (13.2 bits at\n"
            "              the end, a surprise from 6.75 on)\n"
            "  swept       from step 11 of 100 on: what it heard fitted no ocean of its tables\n");
}

TEST(SearchAccount, TellsTheLastSurpriseOfASearchThatWasSurprisedBefore) {
  SearchAccount account;
  account.note({.steps_taken = 8, .believed_source = kSomewhere, .surprise_bits = 9.0F}, Meters{9'000.0});
  account.note({.steps_taken = 9, .believed_source = kSomewhere, .surprise_bits = 2.5F}, Meters{9'000.0});
  EXPECT_EQ(account.to_json().dump(), R"({"surprise_bits":2.5,"surprised_from_step":8,"swept_from_step":null,"declared_found":null})");
  account.note({.steps_taken = 10, .surprise_bits = 2.0F}, Meters{9'000.0});  // an answer that names no place
  EXPECT_EQ(account.to_json()["surprise_bits"], 2.0);
}

TEST(SearchAccount, SaysThatNothingSurprisedAndFromWhenOnItWouldHave) {
  SearchAccount account;
  account.note({.steps_taken = 8, .believed_source = kSomewhere, .surprise_bits = -19.04F}, Meters{9'000.0});
  EXPECT_EQ(account_lines(summary_with(account)),
            "  surprise    none: the oceans of its tables explain what it heard (-19.0 bits at the end, a\n"
            "              surprise from 6.75 on)\n");
}

TEST(SearchAccount, SaysOfASweepBeforeAnySurpriseThatNothingHadBeenHeard) {
  SearchAccount account;
  account.note({.steps_taken = 43, .believed_source = kSomewhere, .surprise_bits = -9.0F, .is_sweeping = true}, Meters{9'000.0});
  EXPECT_EQ(account_lines(summary_with(account)),
            "  surprise    none by what it heard, but it heard less than its tables say (-9.0 bits at the end, a\n"
            "              surprise from 6.75 on)\n"
            "  swept       from step 43 of 100 on: it had heard nothing for long, where its tables say that it\n"
            "              should\n");
}

TEST(SearchAccount, SaysNothingOfSurpriseWhereThePolicyHoldsNoBelief) {
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
  EXPECT_EQ(account_lines(s), "  declared    found at step 34, wrongly: 1021 m from the source\n");
  s["end_reason"] = "declared_found";
  EXPECT_EQ(outcome(s), "declared found, wrongly: 1021 m from the source");
  s["declared_found"]["range_m"] = 1'000.0;
  EXPECT_EQ(account_lines(s), "  declared    found at step 34: 1000 m from the source\n");
}

TEST(SearchAccount, SaysThatAVehicleWhichCameNearTheSourceHasNotDeclaredIt) {
  SearchAccount account;
  account.note({.steps_taken = 18, .believed_source = kSomewhere, .surprise_bits = 1.0F}, Meters{900.0});
  nlohmann::json s = summary_with(account);
  EXPECT_EQ(account_lines(s).find("declared"), std::string::npos);
  s["found"] = true;
  EXPECT_EQ(account_lines(s),
            "  surprise    none: the oceans of its tables explain what it heard (1.0 bits at the end, a surprise\n"
            "              from 6.75 on)\n"
            "  declared    not by the vehicle: the simulator ended the search within a step length of the source;\n"
            "              at sea it would go on\n");
}

TEST(SearchAccount, SaysInWordsWhyAFlightWasLostOrEnded) {
  EXPECT_EQ(outcome({{"found", true}, {"end_reason", "declared_found"}}), "source found");
  EXPECT_EQ(outcome({{"found", false}, {"end_reason", "bus_lost"}}), "the flight was lost: a set-point did not arrive over the bus");
  EXPECT_EQ(outcome({{"found", false}, {"end_reason", "time_used_up"}}), "source not found: time used up");
}

TEST(SearchAccount, SaysWhatIsLeftOfTheBatteryAndWhatWasHeardInLinesThatATerminalHolds) {
  const std::string lines =
      account_lines({{"found", false},
                     {"battery_percent", 41.26},
                     {"hearing", {{"sound", "synthetic"}, {"looks", 123456}, {"looks_too_faint", 23456}, {"search_began_s", 120.4}}}});
  EXPECT_EQ(lines,
            "  battery     41.3 % left\n"
            "  heard       synthetic sound: 123456 SNRs measured, 23456 of them too faint; the first 120 s at\n"
            "              rest, to learn the noise of the sea\n");
}

TEST(SearchAccount, SaysWhichSafetyRuleEndedAFlightAndOnWhatEvidence) {
  const messages::SafetyEvent rule{.time = {},
                                   .rule = 9,
                                   .condition = config::Condition::kBattery,
                                   .response = config::Response::kAbort,
                                   .measure = 29.998,
                                   .limit = 30.0};
  nlohmann::json s{{"found", false}, {"end_reason", "safety_rule"}, {"ended_by", nlohmann::json(ending_rule_to_json(rule))}};
  EXPECT_EQ(ending_rule_to_json(rule).dump(),
            R"({"what":"rule 10, battery_percent: 29.998, below 30.000: abort","rule":10,"condition":"battery_percent","value":29.998,)"
            R"("limit":30.0,"response":"abort"})");
  EXPECT_EQ(outcome(s), "source not found: safety rule 10, battery_percent: 29.998, below 30.000: abort");
  s["end_reason"] = "navigation_stale";
  EXPECT_EQ(outcome(s), "source not found: navigation stale: safety rule 10, battery_percent: 29.998, below 30.000: abort");
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
  EXPECT_EQ(account_lines(summary_with(account)),
            "  went home   by rule 15, battery_at_home_percent: 14.9, below 15.0: return, after 0 steps\n");
  EXPECT_EQ(account.to_json().at("went_home").at("rule"), 15);
  SearchAccount aborted;
  aborted.note({.steps_taken = 3, .rule = rule(14, config::Response::kAbort)}, Meters{9'000.0});
  EXPECT_FALSE(aborted.to_json().contains("went_home")) << "it ended the search";
}

}  // namespace
}  // namespace earshot::fly
