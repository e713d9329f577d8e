#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <set>
#include <vector>

#include "firmware/policy/ocean_belief/ocean_belief.hpp"
#include "tests/firmware/emulated.hpp"
#include "tests/firmware/policy/ocean_belief/ocean_belief_rig.hpp"

namespace earshot::policy {
namespace {

constexpr std::uint64_t kSearches = tests::times(10, 3);

constexpr auto kSteep = [](double km) { return 45.0 - 4.0 * km; };

/// Sources that drift, heard with 1 dB of fluctuation along a zigzag: in how many of the searches they are followed to where they are by
/// the next measurement.
class OceanDrift : public OceanBeliefRig {
 protected:
  OceanDrift() { add_table(tables, 1.0F, kSteep); }

  [[nodiscard]] double share_that_drifts() const {
    double sum = 0.0;
    for (std::size_t i = 0; i < OceanBelief::kHypotheses; ++i)
      sum += belief->hypothesis(i).drift.is_none() ? 0.0 : double{belief->share(i)};
    return sum;
  }

  [[nodiscard]] Measurements measurements_at(const Drift& drift, std::size_t began_in, std::uint64_t seed) const {
    Measurements measurements = zigzag(
        30, [](double) { return 0.0; }, {}, seed);
    int measurement = 0;
    for (auto& [place, reception] : measurements) {
      const double range_km = range_between(place, drifted(drift, measurement++, began_in)).value / 1'000.0;
      reception.snr = Decibels{kSteep(range_km) + 0.5 * reception.snr.value};
    }
    return measurements;
  }

  double share_followed(const Drift& drift, std::size_t began_in) {
    int followed = 0;
    for (std::uint64_t seed = 1; seed <= kSearches; ++seed) {
      belief->start(model, tables);
      hear_all(measurements_at(drift, began_in, seed));
      const double off_m = range_between(belief->summary().likeliest, drifted(drift, 30, began_in)).value;
      followed += share_that_drifts() > 0.9 && off_m < 1'500.0 && likeliest_current(*belief).is_current == drift.is_current ? 1 : 0;
    }
    return followed / static_cast<double>(kSearches);
  }
};

/// At 9/16 of the vehicle's speed; it turns back at the northern edge and at the western one.
TEST_F(OceanDrift, IsFollowedWhereASourceSwimsAndTurnsBack) {
  EXPECT_GE(share_followed({.north = 5, .east = -7}, 8 * 20 + 16), 0.65) << "seven of ten, two of three";
}

/// The vehicle steers by a navigation that does not see a current of a quarter of its speed to the south-west: the source seems to drift to
/// the north-east, out of the area.
TEST_F(OceanDrift, IsFollowedBeyondTheEdgeWhereACurrentHidesFromNavigation) {
  EXPECT_GE(share_followed({.north = 3, .east = 3, .is_current = true}, 16 * 20 + 16), 0.65) << "seven of ten, two of three";
}

TEST_F(OceanDrift, IsSeenInNoSourceThatRestsThoughEightAreRetained) {
  EXPECT_EQ(share_followed({}, 12 * 20 + 8), 0.0);
  EXPECT_LT(range_between(belief->summary().likeliest, drifted({}, 30, 12 * 20 + 8)).value, 1'000.0);
  EXPECT_EQ(retained_that_drift(), 8);
}

/// Where nothing has told it yet from another place; in some searches at once from then on, and earlier where there are bearings.
TEST_F(OceanDrift, IsTriedFromTheEighthMeasurementOnAndWithBearingsFromTheFourth) {
  for (const bool with_bearings : {false, true}) {
    std::set<std::size_t> first_retained;  // after how many measurements
    for (std::uint64_t seed = 1; seed <= kSearches; ++seed) {
      belief->start(model, tables);
      std::size_t heard = 0;
      for (auto [place, reception] : measurements_at({.north = 5, .east = -7}, 8 * 20 + 16, seed)) {
        if (with_bearings) reception.bearing = messages::Bearing{.direction = Radians{0.3}, .deviation = Radians{0.5}};
        belief->update(model, tables, place, reception);
        while (belief->refine(model, tables)) {
        }
        ++heard;
        if (retained_that_drift() == 0) continue;
        first_retained.insert(heard);
        break;
      }
    }
    ASSERT_FALSE(first_retained.empty());
    EXPECT_EQ(*first_retained.begin(), with_bearings ? 4U : 8U);
  }
}

/// The vehicle is further south-west than it believes, as far as each current has carried it.
TEST_F(OceanDrift, HasTheBorderWhereTheVehicleIsUnderEveryCurrent) {
  model.border_width = Meters{2'000};
  belief->start(model, tables);
  const Measurements measurements = measurements_at({.north = 3, .east = 3, .is_current = true}, 16 * 20 + 16, 1);
  hear_all(measurements);
  const NorthEast place = measurements.back().first;
  const std::array<NorthEast, 4> steps{at(1'000, 0), at(0, 1'000), at(-1'000, 0), at(0, -1'000)};
  const auto depth = [](NorthEast vehicle) {
    const double north_m = vehicle.north.value;
    const double east_m = vehicle.east.value;
    const double beyond_m = std::max({2'000.0 - north_m, north_m - 8'000.0, 2'000.0 - east_m, east_m - 8'000.0});
    return std::clamp(beyond_m / 2'000.0, 0.0, 3.0);
  };
  double difference = 0.0;
  for (std::size_t action = 0; action < 4; ++action) {
    double expected = 0.0;
    for (std::size_t i = 0; i < OceanBelief::kHypotheses; ++i) {
      const Drift drift = belief->hypothesis(i).drift;
      const double measurements_of_current = drift.is_current ? 30.0 : 0.0;
      const NorthEast carried = at(62.5 * drift.north * measurements_of_current, 62.5 * drift.east * measurements_of_current);
      expected += double{belief->share(i)} * depth(place + steps[action] - carried);
    }
    EXPECT_NEAR(belief->action_values(action).border, expected, 1e-4) << action;
    difference += std::abs(expected - depth(place + steps[action]));
  }
  EXPECT_GT(difference, 0.5) << "from that of the place where it believes to be";
}

}  // namespace
}  // namespace earshot::policy
