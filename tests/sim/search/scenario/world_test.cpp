#include "sim/search/scenario/world.hpp"

#include <gtest/gtest.h>

#include <string>

#include "sim/search/scenario/scenario_file.hpp"

namespace earshot::search {
namespace {

const std::string kMunk = std::string(EARSHOT_SOURCE_DIR) + "/sim/ocean/environments/munk_flat.toml";
constexpr Meters kDepth{300.0};
constexpr Meters kNear{200.0};

TEST(World, OfThePapersOceanIsCalm) {
  const World world = assemble(load_scenario(kMunk), {}, kDepth, kNear);
  EXPECT_TRUE(world.is_calm());
  EXPECT_EQ(world.actions.size(), 8U);
  EXPECT_EQ(world.soundscape->ocean_count(), 1U);
}

TEST(World, ThatMayBeOneOfTwoOceansIsNotCalm) {
  Scenario scenario = load_scenario(kMunk);
  scenario.other_oceans = {scenario.environment};
  const World world = assemble(scenario, {}, kDepth, kNear);
  EXPECT_EQ(world.soundscape->ocean_count(), 2U);
  EXPECT_FALSE(world.is_calm());
}

TEST(World, HasTheConditionsOfItsScenario) {
  Scenario scenario = load_scenario(kMunk);
  scenario.conditions.fluctuation = Decibels{3.0};
  const World world = assemble(scenario, {}, kDepth, kNear);
  EXPECT_EQ(world.conditions.fluctuation, Decibels{3.0});
  EXPECT_FALSE(world.is_calm());
}

TEST(World, ReachesFromCornerToCornerAndAStepBeyondUnlessToldOtherwise) {
  SearchSettings small;
  small.domain = small.start_region = {{Meters{0.0}, Meters{0.0}}, {Meters{300.0}, Meters{400.0}}};
  small.step_length = Meters{100.0};
  EXPECT_EQ(assemble(load_scenario(kMunk), small, kDepth).expected().max_range(), Meters{600.0});
}

}  // namespace
}  // namespace earshot::search
