#include "policy/explain/flown_paths.hpp"

#include <gtest/gtest.h>

#include "policy/baselines/learned.hpp"
#include "tests/policy/explain/flown_policy.hpp"

namespace earshot::explain {
namespace {

using End = FlownPath::End;

policy::Reception nothing(NorthEast) {
  return {.snr = Decibels{0.0}};
}

/// Goes east, whatever it sees; one start in the middle of its 25 km x 25 km, steps of 1 km.
std::vector<FlownPath> eastward(NorthEast source, std::size_t max_steps = 100) {
  const auto policy = place_policy(1);
  std::ranges::fill(policy->network.layer(2).packed, 0.0F);
  std::ranges::fill(policy->network.layer(2).bias, 0.0F);
  policy->network.layer(2).bias[2] = 20.0F;
  return flown_from_all_over(*policy, falling_ocean(), source, {.per_side = 1, .max_steps = max_steps}, nothing);
}

TEST(FlownPaths, EndWithinAStepOfTheSource) {
  const std::vector<FlownPath> paths = eastward({Meters{12'500.0}, Meters{20'000.0}});
  ASSERT_EQ(paths.size(), 1U);
  EXPECT_EQ(paths[0].end, End::kFound);
  EXPECT_EQ(paths[0].steps(), 7U) << "from 12.5 km in steps of 1 km: 18.5 km is 1.5 km away, 19.5 km is half a kilometre";
  EXPECT_EQ(paths[0].places.front(), (NorthEast{Meters{12'500.0}, Meters{12'500.0}}));
  EXPECT_NEAR(paths[0].places.back().east.value, 19'500.0, 0.01);  // directions are floats
}

TEST(FlownPaths, EndOutsideTheAreaOrAfterAllTheirSteps) {
  const NorthEast in_the_west{Meters{12'500.0}, Meters{1'000.0}};
  const FlownPath leaves = eastward(in_the_west).front();
  EXPECT_EQ(leaves.end, End::kLeft);
  EXPECT_EQ(leaves.steps(), 13U) << "25.5 km lies outside";
  const FlownPath stops = eastward(in_the_west, 5).front();
  EXPECT_EQ(stops.end, End::kStepLimit);
  EXPECT_EQ(stops.steps(), 5U);
}

TEST(FlownPaths, OfAVehicleThatStandsAtTheSourceHaveNoStep) {
  const FlownPath path = eastward({Meters{12'000.0}, Meters{12'500.0}}).front();
  EXPECT_EQ(path.end, End::kFound);
  EXPECT_EQ(path.steps(), 0U);
}

void expect_the_paths_of_the_vehicles_code(const std::unique_ptr<policy::FrozenPolicy>& policy) {
  const NorthEast source{Meters{12'000.0}, Meters{15'000.0}};
  const auto reception_at = [source](NorthEast place) {
    return policy::Reception{.snr = Decibels{40.0 - range_between(place, source).value / 1e3}};
  };
  const std::vector<FlownPath> paths =
      flown_from_all_over(*policy, falling_ocean(), source, {.per_side = 2, .max_steps = 12}, reception_at);
  ASSERT_EQ(paths.size(), 4U);
  baselines::Learned vehicle(*policy, falling_ocean(), policy::ActionDraw::kArgmax, {.south_west = {}, .north_east = policy->area_size},
                             {});
  for (const FlownPath& path : paths) {
    vehicle.begin(Pcg32(1));
    NorthEast place = path.places.front();
    for (std::size_t i = 0; i < path.steps(); ++i) {
      const std::size_t action = vehicle.choose({.position = place, .reception = reception_at(place), .vehicle = place, .source = source});
      place = place + policy->step_length * policy->actions[action];
      EXPECT_EQ(place, path.places[i + 1]) << "step " << i;
    }
  }
}

TEST(FlownPaths, OfABeliefAreThoseThatTheCodeOfTheVehicleFlies) {
  expect_the_paths_of_the_vehicles_code(belief_policy(3));
}

TEST(FlownPaths, OfAPolicyWithoutANetworkAreThoseThatTheCodeOfTheVehicleFlies) {
  expect_the_paths_of_the_vehicles_code(advice_policy());
}

TEST(FlownPaths, AreNeededWhereAPolicySeesMoreThanItsPlace) {
  EXPECT_TRUE(sees_place_alone(*place_policy(1)));
  EXPECT_FALSE(sees_place_alone(*belief_policy(1)));
}

}  // namespace
}  // namespace earshot::explain
