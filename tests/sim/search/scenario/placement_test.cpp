#include "sim/search/scenario/placement.hpp"

#include <gtest/gtest.h>

namespace earshot::search {
namespace {

TEST(SourcePlacementName, IsTheSameBothWays) {
  EXPECT_EQ(placement_named(name_of(SourcePlacement::kFixed)), SourcePlacement::kFixed);
  EXPECT_EQ(placement_named(name_of(SourcePlacement::kChanging)), SourcePlacement::kChanging);
  EXPECT_EQ(placement_named("drifting"), std::nullopt);
}

TEST(StartPlacementName, IsNotGuessed) {
  EXPECT_EQ(start_placement_named("domain"), StartPlacement::kDomain);
  EXPECT_EQ(start_placement_named("inside_border"), StartPlacement::kInsideBorder);
  EXPECT_EQ(start_placement_named("inside"), std::nullopt);
}

TEST(StartPlacement, LeavesTheBorderOutOrNot) {
  SearchSettings settings;
  settings.domain = {{Meters{0.0}, Meters{0.0}}, {Meters{8'000.0}, Meters{10'000.0}}};
  settings.border_width = Meters{500.0};
  const Rectangle everywhere = start_region_of(settings, StartPlacement::kDomain);
  EXPECT_EQ(everywhere.north_east.north, Meters{8'000.0});
  const Rectangle inside = start_region_of(settings, StartPlacement::kInsideBorder);
  EXPECT_EQ(inside.south_west.east, Meters{500.0});
  EXPECT_EQ(inside.north_east.north, Meters{7'500.0});
  EXPECT_EQ(inside.north_east.east, Meters{9'500.0});
}

}  // namespace
}  // namespace earshot::search
