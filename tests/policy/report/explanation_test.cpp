#include "policy/report/explanation.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/policy/report/occurrences.hpp"
#include "tests/support/text/tells.hpp"

namespace earshot::report {
namespace {

TEST(Explanation, WritesAFactorInDigitsAsFarAsTheyCanBeReadAndInPowersOfTenBeyond) {
  EXPECT_EQ(factor_to_string(std::log(1.826)), "\u00D7 1.83");
  EXPECT_EQ(factor_to_string(std::log(20'400.0)), "\u00D7 20\u202F000");
  EXPECT_EQ(factor_to_string(std::log(170.0)), "\u00D7 170");
  EXPECT_EQ(factor_to_string(std::log(0.00213)), "\u00D7 0.0021");
  EXPECT_EQ(factor_to_string(std::log(7.4e7)), "\u00D7 7.4\u00B710\u2077");
  EXPECT_EQ(factor_to_string(std::log(3.2e-12)), "\u00D7 3.2\u00B710\u207B\u00B9\u00B2");
}

/// At the area's south-west corner, the likeliest place 3.2 km NE of it.
explain::DecisionAccount account_of_three() {
  explain::DecisionAccount account;
  account.place.likeliest = {Meters{2'263.0}, Meters{2'263.0}};
  account.actions = {{.name = "E", .end = {}, .hear = {}, .detected = 0.75, .found_soon = 0.12, .approach = Meters{500.0}, .worth = 0.76},
                     {.name = "NE", .end = {}, .hear = {}, .detected = 0.8, .found_soon = 0.41, .approach = Meters{900.0}, .worth = 1.0},
                     {.name = "N", .end = {}, .hear = {}, .detected = 0.7, .found_soon = 0.1, .approach = Meters{400.0}, .worth = 0.5}};
  account.decision.action = 1;
  return account;
}

/// 1 / 0.76 - 1 = 0.316, 1 / 0.95 - 1 = 0.053: what the ratings 0.76 and 0.95 mean in steps without a detection.
constexpr const char* kRated =
    "Why NE and not E: the rest of the search is expected to cost least after NE; E costs 0.32 steps without a detection more. ";

TEST(Explanation, GivesTheRatingFirstAndThenInPhysicalWordsWhyThisDirectionAndNotTheNextBest) {
  EXPECT_EQ(
      why_this_direction(account_of_three()),
      std::string(kRated) + "The likeliest place is 3.2 km NE; NE promises to find the source within three steps with 41 %, E with 12 %.");
}

TEST(Explanation, ComparesApproachAndDetectionWhereBothFindTheSourceAlikeOrNotSoon) {
  explain::DecisionAccount account = account_of_three();
  account.actions[0].found_soon = 0.408;
  EXPECT_EQ(why_this_direction(account),
            std::string(kRated) +
                "The likeliest place is 3.2 km NE; NE promises to find the source within three steps with 41 %, E as much; on average over "
                "the belief NE comes 0.90 km nearer and detects it with 80 %, E 0.50 km and 75 %.");
  for (explain::ActionAccount& action : account.actions) action.found_soon = 0.002;
  EXPECT_EQ(why_this_direction(account),
            std::string(kRated) +
                "The likeliest place is 3.2 km NE; neither finds it within three steps; on average over the belief NE comes 0.90 km nearer "
                "and detects it with 80 %, E 0.50 km and 75 %.");
}

TEST(Explanation, StatesThatTheDifferenceToTheNextBestIsSmall) {
  explain::DecisionAccount account = account_of_three();
  account.actions[0].worth = 0.95;
  EXPECT_TRUE(why_this_direction(account).starts_with(
      "Why NE and not E: the rest of the search is expected to cost least after NE; E costs 0.05 steps without a detection more, a small "
      "difference. The likeliest place"))
      << why_this_direction(account);
}

TEST(Explanation, DoesNotCallADirectionCheapestThatWasDrawnAgainstTheRating) {
  explain::DecisionAccount account = account_of_three();
  account.decision.action = 0;
  EXPECT_TRUE(why_this_direction(account).starts_with(
      "Why E and not NE: the rest of the search is expected to cost least after NE; E costs 0.32 steps without a detection more. "))
      << why_this_direction(account);
}

TEST(Explanation, RatesTheDirectionsOfATrainedPolicyByItsProbabilities) {
  explain::DecisionAccount account = account_of_three();
  for (explain::ActionAccount& action : account.actions) action.worth = std::nullopt;
  account.actions[0].probability = 0.31;
  account.actions[1].probability = 0.51;
  EXPECT_TRUE(why_this_direction(account).starts_with("Why NE and not E: the policy gave NE 51 % and E 31 %. The likeliest place"))
      << why_this_direction(account);
  account.actions[0].probability = 0.48;
  EXPECT_TRUE(why_this_direction(account).starts_with("Why NE and not E: the policy gave NE 51 % and E 48 %, a small difference. "))
      << why_this_direction(account);
}

TEST(Explanation, ShowsTheCostByWhichThePolicyRanksTheDirectionsAndExplainsItBelowTheTable) {
  const std::string table = actions_table(account_of_three());
  for (const char* cost : {"0.32", "0.00", "1.00"})  // 1 / 0.76 - 1, 1 / 1 - 1, 1 / 0.5 - 1
    EXPECT_EQ(count(table, std::string("<td data-name=\"costs more by (steps)\">") + cost + "</td>"), 1U) << cost;
  EXPECT_TRUE(support::has_line(table, {"<li><b>costs more by (steps)</b>", "rest of the search", "ranks the directions"}));
  EXPECT_TRUE(support::has_line(actions_markdown(account_of_three()), {"| E |", "| 0.32 |"}));
}

TEST(Explanation, StatesThatATrainedPolicyRanksTheDirectionsByItsProbabilities) {
  explain::DecisionAccount account = account_of_three();
  for (explain::ActionAccount& action : account.actions) action.worth = std::nullopt;
  EXPECT_EQ(count(actions_table(account), "costs more by"), 0U);
  EXPECT_TRUE(support::has_line(actions_table(account), {"<li><b>chosen with (%)</b>", "ranks the directions by it"}));
}

TEST(Explanation, NamesEveryCellOfADirectionForANarrowScreenAndExplainsEveryColumn) {
  const std::string table = actions_table(account_of_three());
  for (const char* name : {"chosen with (%)", "costs more by (steps)", "expected SNR (dB)", "detects (%)", "finds (%)",
                           "finds within 3 steps (%)", "nearer by (km)", "border"}) {
    EXPECT_EQ(count(table, std::string("<td data-name=\"") + name + "\""), 3U) << name;
    EXPECT_EQ(count(table, std::string("<th>") + name + "</th>"), 1U) << name;
    EXPECT_EQ(count(table, std::string("<li><b>") + name + "</b>: "), 1U) << name;
  }
}

TEST(Explanation, StatesWhetherThePolicyTakesItsLikeliestDirectionOrDrawsLots) {
  explain::DecisionAccount account = account_of_three();
  account.actions[1].probability = 0.51;
  account.actions[0].probability = 0.31;
  account.likeliest_action = 1;
  account.draw = policy::ActionDraw::kArgmax;
  EXPECT_EQ(choice_sentence(account), "It chose NE: this policy always takes the direction with the highest probability, here 51 %.");
  account.draw = policy::ActionDraw::kSampled;
  EXPECT_EQ(choice_sentence(account), "It chose NE, which had 51 %: this policy draws lots by its probabilities.");
  account.decision.action = 0;
  EXPECT_EQ(choice_sentence(account),
            "It chose E, which had 31 %: this policy draws lots by its probabilities, and NE was likelier with 51 %.");
}

TEST(Explanation, CallsTheLikeliestPlaceASinglePlaceOfABeliefThatIsSpread) {
  EXPECT_EQ(count(sentences(account_of_three()).at(1), "the likeliest single place of a belief that is spread); with 50 %"), 1U);
}

TEST(Explanation, TellsAMeasurementTooFaintToMeasureFromAMeasuredOne) {
  EXPECT_EQ(to_string(policy::Reception{.snr = Decibels{9.46}, .too_faint = false}), "9.5 dB");
  EXPECT_EQ(to_string(policy::Reception{.snr = Decibels{5.0}, .too_faint = true}), "under 5.0 dB");
}

TEST(Explanation, TellsFromWhereAMeasurementWasHeardAndItsMirrorImage) {
  policy::Reception reception{.snr = Decibels{9.46}};
  reception.bearing = messages::Bearing{.direction = Radians{0.8203}, .deviation = Radians{0.1745}};  // 47 and 10 degrees
  EXPECT_EQ(to_string(reception), "9.5 dB from 047\u00B0 \u00B1 10\u00B0");
  reception.bearing->mirror_axis = Radians{0.3491};  // 20 degrees
  EXPECT_EQ(to_string(reception), "9.5 dB from 047\u00B0 or 353\u00B0 \u00B1 10\u00B0");
}

}  // namespace
}  // namespace earshot::report
