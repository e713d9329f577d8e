#include "policy/report/explanation.hpp"

#include <gtest/gtest.h>

#include <cmath>

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

TEST(Explanation, GivesInPhysicalWordsWhyThisDirectionAndNotTheNextBest) {
  EXPECT_EQ(
      why_this_direction(account_of_three()),
      "Why NE and not E, the next best: the likeliest place is 3.2 km NE; NE promises to find the source within three steps with 41 %, "
      "E with 12 %.");
}

TEST(Explanation, ComparesApproachAndDetectionWhereBothFindTheSourceAlikeOrNotSoon) {
  explain::DecisionAccount account = account_of_three();
  account.actions[0].found_soon = 0.408;
  EXPECT_EQ(why_this_direction(account),
            "Why NE and not E, the next best: the likeliest place is 3.2 km NE; NE promises to find the source within three steps with 41 "
            "%, E as "
            "much; on average over the belief NE comes 0.90 km nearer and detects it with 80 %, E 0.50 km and 75 %.");
  for (explain::ActionAccount& action : account.actions) action.found_soon = 0.002;
  EXPECT_EQ(why_this_direction(account),
            "Why NE and not E, the next best: the likeliest place is 3.2 km NE; neither finds it within three steps; on average over the "
            "belief NE "
            "comes 0.90 km nearer and detects it with 80 %, E 0.50 km and 75 %.");
}

TEST(Explanation, RatesAnAdvisedChoiceAndTheNextBest) {
  explain::DecisionAccount account = account_of_three();
  EXPECT_EQ(because(account),
            "All costs of the search together, the belief rates NE 1.00 and E 0.76 (1: the best direction, 0: the worst).");
  account.decision.action = 0;
  EXPECT_EQ(because(account),
            "All costs of the search together, the belief rates E 0.76 and NE 1.00 (1: the best direction, 0: the worst).");
}

TEST(Explanation, TellsALookTooFaintToMeasureFromAMeasuredOne) {
  EXPECT_EQ(to_string(policy::Reception{.snr = Decibels{9.46}, .too_faint = false}), "9.5 dB");
  EXPECT_EQ(to_string(policy::Reception{.snr = Decibels{5.0}, .too_faint = true}), "under 5.0 dB");
}

TEST(Explanation, TellsFromWhereALookWasHeardAndItsMirrorImage) {
  policy::Reception reception{.snr = Decibels{9.46}};
  reception.bearing = messages::Bearing{.direction = Radians{0.8203}, .deviation = Radians{0.1745}};  // 47 and 10 degrees
  EXPECT_EQ(to_string(reception), "9.5 dB from 047\u00B0 \u00B1 10\u00B0");
  reception.bearing->mirror_axis = Radians{0.3491};  // 20 degrees
  EXPECT_EQ(to_string(reception), "9.5 dB from 047\u00B0 or 353\u00B0 \u00B1 10\u00B0");
}

}  // namespace
}  // namespace earshot::report
