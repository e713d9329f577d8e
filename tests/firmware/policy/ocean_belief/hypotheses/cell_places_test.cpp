#include "firmware/policy/ocean_belief/hypotheses/cell_places.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <memory>

#include "tests/firmware/policy/belief/belief_rig.hpp"

namespace earshot::policy {
namespace {

constexpr Meters kHalfKilometre{500};

/// 4 km x 9 km in 2 x 3 cells of 2 km x 3 km; a sixteenth of a step is 100 m.
BeliefModel oblong() {
  BeliefModel model = bare_model(at(4'000, 9'000), 2, 3);
  model.step_length = Meters{1'600};
  return model;
}

class CellPlacesTest : public testing::Test {
 protected:
  /// Ranges in range steps, from the corner of the area.
  [[nodiscard]] std::array<std::uint16_t, 6> ranges_from(NorthEast position) const {
    std::array<std::uint16_t, 6> ranges;
    places->find_ranges(oblong(), position, kHalfKilometre, 1'000, ranges);
    return ranges;
  }
  std::unique_ptr<CellPlaces> places = std::make_unique<CellPlaces>();
};

TEST_F(CellPlacesTest, AreTheCentresWhereNothingDrifts) {
  places->find(oblong(), {}, 7, {});
  // East of it 4, 7 and 10 km; and those with 2 km to the north: 4.472, 7.280 and 10.198 km.
  EXPECT_EQ(ranges_from(at(1'000, -2'500)), (std::array<std::uint16_t, 6>{8, 14, 20, 9, 15, 20}));
  std::array<std::uint16_t, 6> ranges;
  places->find_ranges(oblong(), at(1'000, -2'500), kHalfKilometre, 14, ranges);
  EXPECT_EQ(ranges, (std::array<std::uint16_t, 6>{8, 14, 14, 9, 14, 14}));
}

/// More columns than are ever taken side by side, each of a kilometre.
TEST_F(CellPlacesTest, AreAsManyAsTheGridHasColumns) {
  constexpr std::size_t kColumns = 75;
  const BeliefModel model = bare_model(at(4'000, 75'000), 2, kColumns);
  places->find(model, {}, 0, {});
  std::array<std::uint16_t, 2 * kColumns> ranges;
  places->find_ranges(model, at(1'000, -500), kHalfKilometre, 1'000, ranges);
  for (std::size_t e = 0; e < kColumns; ++e) {
    const double km = static_cast<double>(e + 1);
    EXPECT_EQ(ranges[e], 2 * (e + 1));
    EXPECT_EQ(ranges[kColumns + e], std::lround(2.0 * std::hypot(2.0, km))) << e;
  }
}

/// 10 measurements of 300 m to the north and 500 m to the west: the area goes with it.
TEST_F(CellPlacesTest, GoBeyondTheEdgesWithACurrent) {
  places->find(oblong(), {.north = 3, .east = -5, .is_current = true}, 10, {});
  // Rows at 4 and 6 km, columns at -3.5, -0.5 and 2.5 km.
  EXPECT_EQ(ranges_from(at(4'000, -3'500)), (std::array<std::uint16_t, 6>{0, 6, 12, 4, 7, 13}));  // 2 km, and 3.606, 6.325
}

/// From 1 and 3 km, 3 km further, there is an edge at 4 km; from 1.5, 4.5 and 7.5 km, 5 km back, one at 0.
TEST_F(CellPlacesTest, TurnBackAtTheEdgesWithASourceThatSwims) {
  places->find(oblong(), {.north = 3, .east = -5}, 10, {});
  // Rows at 4 and 2 km, columns at 3.5, 0.5 and 2.5 km.
  EXPECT_EQ(ranges_from(at(4'000, 500)), (std::array<std::uint16_t, 6>{6, 0, 4, 7, 4, 6}));  // with 2 km: 3.606, 2, 2.828
}

/// Against a source that is reflected leg by leg, for longer than any search.
TEST_F(CellPlacesTest, TurnBackAsOftenAsTheyMeetAnEdge) {
  const Drift drift{.north = -13, .east = 9};
  double north = 3'000;
  double north_speed = -1'300;
  double east = 7'500;
  double east_speed = 900;
  for (std::uint32_t measurement = 1; measurement <= 300; ++measurement) {
    const auto reflect = [](double& place, double& speed, double width) {
      place += speed;
      if (place < 0.0 || place > width) {
        place = place < 0.0 ? -place : 2.0 * width - place;
        speed = -speed;
      }
    };
    reflect(north, north_speed, 4'000);
    reflect(east, east_speed, 9'000);
    places->find(oblong(), drift, measurement, {});
    ASSERT_EQ(ranges_from(at(north, east))[5], 0) << measurement;
  }
}

TEST_F(CellPlacesTest, CountFromACornerThatHasDrifted) {
  const Drift drift{.north = 3, .east = -5, .is_current = true};
  places->find(oblong(), drift, 10, at(3'000, -5'000));
  EXPECT_EQ(ranges_from(at(1'000, 1'500)), (std::array<std::uint16_t, 6>{0, 6, 12, 4, 7, 13}));
  std::array<std::uint16_t, 6> cells;
  places->find_cells(oblong(), cells);
  EXPECT_EQ(cells, (std::array<std::uint16_t, 6>{0, 1, 2, 3, 4, 5}));
}

TEST_F(CellPlacesTest, LieInTheCellThatHoldsThemAndBeyondTheEdgesInTheLast) {
  std::array<std::uint16_t, 6> cells;
  places->find(oblong(), {.north = 3, .east = -5, .is_current = true}, 10, {});  // 4 and 6 km; -3.5, -0.5 and 2.5 km
  places->find_cells(oblong(), cells);
  EXPECT_EQ(cells, (std::array<std::uint16_t, 6>{3, 3, 3, 3, 3, 3}));
  places->find(oblong(), {.north = -1, .east = 6, .is_current = true}, 8, {});  // 0.2 and 2.2 km; 6.3, 9.3 and 12.3 km
  places->find_cells(oblong(), cells);
  EXPECT_EQ(cells, (std::array<std::uint16_t, 6>{2, 2, 2, 5, 5, 5}));
}

}  // namespace
}  // namespace earshot::policy
