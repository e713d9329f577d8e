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

TEST(Explanation, OfAnAdvisedChoiceComparesItsWorthWithThatOfTheNextBest) {
  explain::DecisionAccount account;
  account.actions = {{.name = "S", .end = {}, .hear = {}, .approach = {}, .worth = 0.76},
                     {.name = "W", .end = {}, .hear = {}, .approach = {}, .worth = 1.0},
                     {.name = "SW", .end = {}, .hear = {}, .approach = {}, .worth = 0.931}};
  account.decision.action = 1;
  EXPECT_EQ(because(account),
            "By its belief's advice W was worth the most, 1.00 (of 1 for the best and 0 for the worst); next came SW with 0.93 and S with "
            "0.76.");
  account.decision.action = 2;
  EXPECT_EQ(because(account),
            "By its belief's advice SW was worth 0.93 (of 1 for the best and 0 for the worst); beside it W with 1.00 and S with 0.76.");
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
