#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "firmware/core/geometry.hpp"
#include "firmware/policy/belief/belief_model.hpp"

namespace earshot::policy {

// The cells of a belief seen from the vehicle: how far they lie, and over how many ranges each of them lies at once.

/// Some neighbouring rows of a belief's cells, and some columns of them.
struct CellWindow {
  struct Side {
    std::uint16_t first;
    std::uint16_t end;  ///< behind the last
    friend constexpr bool operator==(const Side&, const Side&) = default;
  };
  Side north;
  Side east;
  friend constexpr bool operator==(const CellWindow&, const CellWindow&) = default;
};

/// All of them.
[[nodiscard]] constexpr CellWindow all_cells(const BeliefModel& model) {
  return {.north = {0, model.cells_north}, .east = {0, model.cells_east}};
}

/// The cells along one axis whose centres can lie within `radius` of `place`, m.
/// @param size   of a cell, m   @param count  of the cells
[[nodiscard]] CellWindow::Side cells_along(float place, float radius, float size, std::size_t count);

/// Sides of a cell, m.
[[nodiscard]] double cell_north(const BeliefModel& model);
[[nodiscard]] double cell_east(const BeliefModel& model);

/// From the vehicle to the centre of a cell. @param cell  index in [north x east]
[[nodiscard]] NorthEast way_to_cell(const BeliefModel& model, NorthEast position, std::size_t cell);

/// Range steps in half a cell, less than `ranges`: a likelihood is smoothed by as much, for a cell lies at many ranges at once.
[[nodiscard]] std::size_t half_cell(const BeliefModel& model, Meters range_step, std::size_t ranges);

/// Of samples of a table, one every range_step, so many from the nearest reach to every place of the area, and `beyond` further.
/// @return at least one, at most `ranges`
[[nodiscard]] std::size_t ranges_to_all(const BeliefModel& model, NorthEast position, Meters beyond, Meters range_step, std::size_t ranges);

/// Mean over the `half` samples to either side of each; beyond the ends the first and the last hold.
void smooth(std::span<const float> values, std::size_t half, std::span<float> smoothed);

/// Share of a cell, its centre at each range, that lies further than step_length from the vehicle; at least a thousandth: navigation errs,
/// sources move.
/// @param shares  [ranges]; the result
void find_uncovered(const BeliefModel& model, Meters range_step, std::span<float> shares);

}  // namespace earshot::policy
