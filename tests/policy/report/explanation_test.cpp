#include "policy/report/explanation.hpp"

#include <gtest/gtest.h>

#include "tests/policy/report/occurrences.hpp"
#include "tests/support/text/tells.hpp"

namespace earshot::report {
namespace {

/// At the area's south-west corner, the likeliest place 3.2 km NE of it; steps of 1 km.
explain::DecisionAccount account_of_three() {
  constexpr NorthEast kEnd{Meters{600.0}, Meters{800.0}};
  explain::DecisionAccount account;
  account.most_regret_steps = 10.0;
  account.place.likeliest = {Meters{2'263.0}, Meters{2'263.0}};
  account.actions = {{.name = "E", .end = kEnd, .hear = {}, .detected = 0.75, .found_soon = 0.12, .approach = Meters{500.0}, .worth = 0.76},
                     {.name = "NE", .end = kEnd, .hear = {}, .detected = 0.8, .found_soon = 0.41, .approach = Meters{900.0}, .worth = 1.0},
                     {.name = "N", .end = kEnd, .hear = {}, .detected = 0.7, .found_soon = 0.1, .approach = Meters{400.0}, .worth = 0.5}};
  account.decision.action = 1;
  return account;
}

/// 1 / 0.76 - 1 = 0.316, 1 / 0.95 - 1 = 0.053: what the ratings 0.76 and 0.95 mean in steps without a detection.
constexpr const char* kRated =
    "Why NE and not E: the rest of the search is expected to cost least after NE; E is expected to cost 0.32 more (1 = one step without a "
    "detection). ";

/// Of a step of 1 km 0.4 km are 0.4; the probabilities differ by 0.29 and 0.05.
TEST(Explanation, GivesTheRatingFirstAndThenInPhysicalWordsWhatSpeaksForTheDirectionTheStrongestFirst) {
  EXPECT_EQ(why_this_direction(account_of_three()),
            std::string(kRated) +
                "The likeliest place is 3.2 km NE. For NE: it ends 0.90 km nearer (E 0.50 km nearer); it finds the source within three "
                "steps with 41 % (E 12 %); it detects the source with 80 % (E 75 %).");
}

TEST(Explanation, NamesWhatSpeaksForTheOtherDirectionLastTheStrongestFirstAndLeavesOutWhatIsAlike) {
  explain::DecisionAccount account = account_of_three();
  account.actions[0].found_soon = 0.408;  // as it is printed the same as 41 %
  account.actions[0].approach = Meters{1'000.0};
  account.actions[1].approach = Meters{-110.0};
  EXPECT_EQ(why_this_direction(account), std::string(kRated) +
                                             "The likeliest place is 3.2 km NE. For NE: it detects the source with 80 % (E 75 %). For "
                                             "E: it ends 1.00 km nearer (NE 0.11 km further off).");
  account.actions[0].found_soon = 0.5;
  EXPECT_TRUE(why_this_direction(account).ends_with(
      " For E: it ends 1.00 km nearer (NE 0.11 km further off); it finds the source within three steps with 50 % (NE 41 %)."))
      << why_this_direction(account);
}

TEST(Explanation, SaysThatADirectionThatIsCheapestPromisesNoMoreInTheNextSteps) {
  explain::DecisionAccount account = account_of_three();
  account.actions[1].found_soon = account.actions[0].found_soon;
  account.actions[1].approach = account.actions[0].approach;
  account.actions[1].detected = 0.7;
  EXPECT_EQ(why_this_direction(account),
            std::string(kRated) +
                "The likeliest place is 3.2 km NE. In the next steps NE promises no more than E; the cost "
                "counts all steps of the search that follow. For E: it detects the source with 75 % (NE 70 %).");
}

TEST(Explanation, SaysThatBothDirectionsPromiseTheSame) {
  explain::DecisionAccount account = account_of_three();
  account.actions[0] = account.actions[1];
  account.actions[0].name = "E";
  account.actions[0].worth = 0.76;
  EXPECT_EQ(why_this_direction(account), std::string(kRated) + "The likeliest place is 3.2 km NE. Both promise the same.");
}

TEST(Explanation, CallsWhatAPolicyDoesNotKnowAnObserversWords) {
  explain::DecisionAccount account = account_of_three();
  account.belief_is_the_policys = account.uses_measurements = false;
  std::string text;
  for (const std::string& sentence : sentences(account)) text += sentence + "\n";
  EXPECT_TRUE(support::has_line(text, {"The SNR here was", "does not use it", "place and steps alone"}));
  EXPECT_TRUE(support::has_line(text, {"Why NE", "To an observer who knows the ocean the likeliest place"}));
  EXPECT_TRUE(support::has_line(text, {"an observer would expect an SNR"}));
  EXPECT_EQ(count(text, "It measured"), 0U);
  EXPECT_EQ(count(text, "it expects"), 0U);
}

TEST(Explanation, StatesFirstThatTheNextBestIsNearlyEqual) {
  explain::DecisionAccount account = account_of_three();
  account.actions[0].worth = 0.95;
  EXPECT_TRUE(
      why_this_direction(account).starts_with("Why NE and not E: the two are nearly equal, but the rest of the search is expected to cost "
                                              "least after NE; E is expected to cost 0.05 "
                                              "more (1 = one step without a detection). The likeliest place"))
      << why_this_direction(account);
}

TEST(Explanation, DoesNotCallADirectionCheapestThatWasDrawnAgainstTheRating) {
  explain::DecisionAccount account = account_of_three();
  account.decision.action = 0;
  EXPECT_TRUE(why_this_direction(account).starts_with(
      "Why E and not NE: the rest of the search is expected to cost least after NE; E is expected to cost 0.32 more (1 = one step without "
      "a detection). "))
      << why_this_direction(account);
}

TEST(Explanation, RatesTheDirectionsOfATrainedPolicyByItsScores) {
  explain::DecisionAccount account = account_of_three();
  for (explain::ActionAccount& action : account.actions) action.worth = std::nullopt;
  account.actions[0].probability = 0.31;
  account.actions[1].probability = 0.51;
  EXPECT_TRUE(why_this_direction(account).starts_with("Why NE and not E: the policy gave NE 51 % and E 31 %. The likeliest place"))
      << why_this_direction(account);
  account.actions[0].probability = 0.48;
  EXPECT_TRUE(
      why_this_direction(account).starts_with("Why NE and not E: the two are nearly equal, but the policy gave NE 51 % and E 48 %. "))
      << why_this_direction(account);
}

TEST(Explanation, ShowsTheCostByWhichThePolicyRanksTheDirectionsAndExplainsItBelowTheTable) {
  const std::string table = actions_markdown(account_of_three());
  EXPECT_TRUE(support::has_line(table, {"| E |", "| 0.32 |"}));   // 1 / 0.76 - 1
  EXPECT_TRUE(support::has_line(table, {"| NE |", "| 0.00 |"}));  // 1 / 1 - 1
  EXPECT_TRUE(support::has_line(table, {"| N |", "| 1.00 |"}));   // 1 / 0.5 - 1
  EXPECT_TRUE(support::has_line(table, {"- regret (steps): ", "rest of the search", "ranks the directions"}));
  EXPECT_TRUE(support::has_line(table, {"the best has 0; 10 or more is shown as 10."}));
}

TEST(Explanation, GivesScoresOfAPolicyThatTakesTheBestDirectionAndProbabilitiesOfOneThatDrawsLots) {
  explain::DecisionAccount account = account_of_three();
  EXPECT_TRUE(
      support::has_line(actions_markdown(account), {"- score (%): ", "made from the regret", "takes the direction with the highest"}));
  EXPECT_EQ(count(actions_markdown(account), "probability with which"), 0U);
  for (explain::ActionAccount& action : account.actions) action.worth = std::nullopt;
  EXPECT_EQ(count(actions_markdown(account), "regret"), 0U);
  EXPECT_TRUE(support::has_line(actions_markdown(account), {"- score (%): ", "takes the direction with the highest"}));
  account.draw = policy::ActionDraw::kSampled;
  EXPECT_EQ(count(actions_markdown(account), "score"), 0U);
  EXPECT_TRUE(support::has_line(actions_markdown(account), {"- chosen with (%): ", "probability with which the policy draws"}));
}

TEST(Explanation, ExplainsEveryColumnOfItsTable) {
  const std::string table = actions_markdown(account_of_three());
  for (const char* name : {"score (%)", "regret (steps)", "expected SNR (dB)", "detects (%)", "finds (%)", "finds within 3 steps (%)",
                           "nearer by (km)", "border"}) {
    EXPECT_EQ(count(table, std::string("| ") + name + " |"), 1U) << name;
    EXPECT_EQ(count(table, std::string("- ") + name + ": "), 1U) << name;
  }
}

TEST(Explanation, StatesWhetherThePolicyTakesItsLikeliestDirectionOrDrawsLots) {
  explain::DecisionAccount account = account_of_three();
  account.actions[1].probability = 0.51;
  account.actions[0].probability = 0.31;
  account.likeliest_action = 1;
  account.draw = policy::ActionDraw::kArgmax;
  EXPECT_EQ(choice_sentence(account),
            "It chose NE: this policy always takes the direction after which the search is expected to cost least.");
  for (explain::ActionAccount& action : account.actions) action.worth = std::nullopt;
  EXPECT_EQ(choice_sentence(account), "It chose NE: this policy always takes the direction with the highest score, here 51 %.");
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
