#include "policy/report/search_account.hpp"

#include <gtest/gtest.h>

namespace earshot::report {
namespace {

TEST(SearchAccountInReport, SaysSurpriseSweepAndDeclarationInOneParagraph) {
  const nlohmann::json summary{{"surprise_bits", 13.25},   {"surprised_from_step", 9U},
                               {"swept_from_step", 11U},   {"max_steps", 100U},
                               {"step_length_m", 1'000.0}, {"declared_found", {{"step", 34U}, {"range_m", 1'020.6}}}};
  ASSERT_EQ(fault_in_account(summary), "");
  EXPECT_EQ(to_string(account_in(summary)),
            "From step 9 on what it heard was unlikely in every ocean of its tables (surprise 13.2 bits at the end, which counts from 6.75 "
            "on). Swept from step 11 of 100 on: what it heard fitted no ocean of its tables. Declared found at step 34, wrongly: 1021 m "
            "from the source.");
}

TEST(SearchAccountInReport, SaysThatNothingWasUnexpectedAndFromWhenOnItWouldBe) {
  EXPECT_EQ(
      to_string({.believes = true, .surprise_bits = -19.04}),
      "Nothing unexpected: the oceans of its tables explain what it heard (surprise -19.0 bits at the end, which would count from 6.75 "
      "on).");
}

TEST(SearchAccountInReport, SaysOfASweepBeforeAnySurpriseThatNothingHadBeenHeard) {
  EXPECT_EQ(to_string({.believes = true, .surprise_bits = -9.0, .sweep_step = 43, .max_steps = 100}),
            "Its tables explain what it heard, but not that it was so little (surprise -9.0 bits at the end, which would count from 6.75 "
            "on). Swept from step 43 of 100 on: it had heard nothing for long, where its tables say that it should.");
  const SearchAccount surprised_later{.believes = true, .surprise_bits = 7.0, .surprised_step = 44, .sweep_step = 43};
  EXPECT_TRUE(surprised_later.swept_in_silence());
  const SearchAccount surprised{.believes = true, .surprise_bits = 13.0, .surprised_step = 43, .sweep_step = 43};
  EXPECT_FALSE(surprised.swept_in_silence());
}

TEST(SearchAccountInReport, SaysThatAVehicleWhichCameNearTheSourceHasNotDeclaredIt) {
  const nlohmann::json summary{{"found", true}, {"surprise_bits", 1.0}, {"declared_found", nullptr}};
  EXPECT_EQ(to_string(account_in(summary)),
            "Nothing unexpected: the oceans of its tables explain what it heard (surprise 1.0 bits at the end, which would count from 6.75 "
            "on). Not declared found by the vehicle: the simulator ended the search within a step length of the source; at sea it would go "
            "on.");
  EXPECT_FALSE(account_in({{"found", true}, {"surprise_bits", nullptr}}).is_found_undeclared)
      << "a policy without a belief declares nothing";
}

TEST(SearchAccountInReport, CallsADeclarationWrongFromMoreThanAStepLengthOn) {
  EXPECT_EQ(declared_where({.declared_range_m = 1'000.0, .step_length_m = 1'000.0}), ": 1000 m from the source");
  EXPECT_EQ(declared_where({.declared_range_m = 1'001.0, .step_length_m = 1'000.0}), ", wrongly: 1001 m from the source");
  EXPECT_EQ(to_string({.declared_step = 7}), "Declared found at step 7.") << "at sea nobody knows where the source was";
}

TEST(SearchAccountInReport, SaysNothingOfASummaryOfAnEarlierVersionOrOfAPolicyWithoutABelief) {
  EXPECT_EQ(to_string(account_in({{"found", false}})), "");
  EXPECT_EQ(to_string(account_in({{"surprise_bits", nullptr}, {"declared_found", nullptr}})), "");
}

TEST(SearchAccountInReport, RefusesWhatIsNoStepNoNumberAndNoDeclaration) {
  EXPECT_EQ(fault_in_account({{"surprise_bits", "much"}}), "surprise_bits: must be a number");
  EXPECT_EQ(fault_in_account({{"swept_from_step", -1}}), "swept_from_step: must be a whole number, 0 to 1000000000");
  EXPECT_EQ(fault_in_account({{"declared_found", {{"step", 3}}}}), "declared_found: must be step, range_m");
}

}  // namespace
}  // namespace earshot::report
