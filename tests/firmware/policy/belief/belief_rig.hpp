#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "firmware/policy/action_values/action_values.hpp"
#include "firmware/policy/belief/belief_model.hpp"
#include "tests/firmware/place.hpp"

namespace earshot::policy {

inline constexpr std::size_t kNorth = 0;
inline constexpr std::size_t kEast = 1;
inline constexpr std::size_t kSouth = 2;
inline constexpr std::size_t kWest = 3;

/// An area in equal cells, four actions, and nothing that is heard in another way than modelled.
inline BeliefModel bare_model(NorthEast area_size, std::uint16_t cells_north, std::uint16_t cells_east) {
  BeliefModel model;
  model.area_size = area_size;
  model.cells_north = cells_north;
  model.cells_east = cells_east;
  model.outlier_share = 0.0F;
  for (const UnitNorthEast direction : {UnitNorthEast{1, 0}, UnitNorthEast{0, 1}, UnitNorthEast{-1, 0}, UnitNorthEast{0, -1}}) {
    EXPECT_EQ(model.actions.push_back(direction), Status::kOk);
  }
  return model;
}

/// As many samples as the shorter of two tables has.
inline std::vector<RangeSample> samples_of(std::span<const float> search_cost, std::span<const float> detected) {
  std::vector<RangeSample> samples(std::min(search_cost.size(), detected.size()));
  find_samples(search_cost.first(samples.size()), detected.first(samples.size()), samples);
  return samples;
}

}  // namespace earshot::policy
