#pragma once

#include <gtest/gtest.h>

#include <cstddef>
#include <initializer_list>
#include <memory>

#include "firmware/policy/belief.hpp"

namespace earshot::policy {

inline NorthEast at(double north, double east) {
  return {.north = Meters{north}, .east = Meters{east}};
}

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
  model.forgotten_share = 0.0F;
  for (const UnitNorthEast direction : {UnitNorthEast{1, 0}, UnitNorthEast{0, 1}, UnitNorthEast{-1, 0}, UnitNorthEast{0, -1}}) {
    EXPECT_EQ(model.actions.push_back(direction), Status::kOk);
  }
  return model;
}

/// 20 km x 20 km in cells of 500 m; the SNR falls from 30 dB by 1 dB every kilometre, so that a detection is one within 20 km.
inline BeliefModel flat_model(std::initializer_list<BeliefHypothesis> hypotheses) {
  BeliefModel model = bare_model(at(20'000, 20'000), 40, 40);
  for (const BeliefHypothesis& hypothesis : hypotheses) EXPECT_EQ(model.hypotheses.push_back(hypothesis), Status::kOk);
  for (int i = 0; i < 300; ++i) EXPECT_EQ(model.snr_db.push_back(static_cast<float>(300 - i) / 10.0F), Status::kOk);
  return model;
}

inline double snr_at(NorthEast place, NorthEast source) {
  return 30.0 - range_between(place, source).value / 1'000.0;
}

inline NorthEast centre(std::size_t north, std::size_t east) {
  return at((static_cast<double>(north) + 0.5) * 500.0, (static_cast<double>(east) + 0.5) * 500.0);
}

class BeliefTest : public testing::Test {
 protected:
  void hear(const BeliefModel& model, NorthEast place, double snr_db) { belief->update(model, place, {.snr = Decibels{snr_db}}); }
  void hear_nothing(const BeliefModel& model, NorthEast place, double floor_db) {
    belief->update(model, place, {.snr = Decibels{floor_db}, .too_faint = true});
  }
  [[nodiscard]] double probability_at(const BeliefModel& model, NorthEast place) const {
    return double{belief->probability(model, static_cast<std::size_t>(place.north.value / 500.0),
                                      static_cast<std::size_t>(place.east.value / 500.0))};
  }

  std::unique_ptr<Belief> belief = std::make_unique<Belief>();
};

}  // namespace earshot::policy
