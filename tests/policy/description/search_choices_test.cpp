#include "policy/description/search_choices.hpp"

#include <gtest/gtest.h>

namespace earshot::description {
namespace {

TrainedTask fixed_source() {
  return {.source = search::SourcePlacement::kFixed,
          .start_margin = Meters{0.0},
          .border_width = Meters{500.0},
          .max_steps = 60,
          .vehicle_depth = Meters{250.0}};
}

TEST(SearchChoicesTest, AreTheTrainingsWhereNothingIsGiven) {
  const SearchChoices options = with_trained({}, fixed_source());
  EXPECT_EQ(options.source, "fixed");
  EXPECT_EQ(options.start, "domain");
  EXPECT_EQ(options.start_margin_m, std::nullopt);
  EXPECT_EQ(options.border_width_m, 500.0);
  EXPECT_EQ(options.max_steps, 60U);
  EXPECT_EQ(options.vehicle_depth_m, 250.0);
}

TEST(SearchChoicesTest, AreThoseGivenWhateverWasTrained) {
  const SearchChoices options =
      with_trained({.vehicle_depth_m = 100.0, .source = "changing", .start = "inside_border", .border_width_m = 2'000.0, .max_steps = 30},
                   fixed_source());
  EXPECT_EQ(options.source, "changing");
  EXPECT_EQ(options.start, "inside_border");
  EXPECT_EQ(options.border_width_m, 2'000.0);
  EXPECT_EQ(options.max_steps, 30U);
  EXPECT_EQ(options.vehicle_depth_m, 100.0);
  EXPECT_EQ(with_trained({.start_margin_m = 0.0}, fixed_source()).start, std::nullopt) << "of margin and region one is given";
}

TEST(SearchChoicesTest, HaveAStartsRegionByItsNameOrItsMarginNeverBoth) {
  EXPECT_EQ(with_trained({}, {.start_margin = Meters{1'000.0}, .border_width = Meters{1'000.0}}).start, "inside_border");
  const SearchChoices margin = with_trained({}, {.start_margin = Meters{7'500.0}, .border_width = Meters{500.0}});
  EXPECT_EQ(margin.start, std::nullopt);
  EXPECT_EQ(margin.start_margin_m, 7'500.0);
  EXPECT_EQ(with_trained({}, {.start = search::StartPlacement::kDomain}).start, "domain");
}

TEST(SearchChoicesTest, StartInsideTheBorderAndAreSilentOfTheRestWhereTheTrainingIsNotKnown) {
  const SearchChoices options = with_trained({}, {});
  EXPECT_EQ(options.start, "inside_border");
  EXPECT_EQ(options.source, std::nullopt);
  EXPECT_EQ(options.border_width_m, std::nullopt);
  EXPECT_EQ(options.max_steps, std::nullopt);
  EXPECT_EQ(options.vehicle_depth_m, std::nullopt);
}

}  // namespace
}  // namespace earshot::description
