#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "firmware/config/capacities.hpp"
#include "firmware/policy/belief/belief_model.hpp"
#include "firmware/policy/ocean_belief/hypotheses/drift.hpp"

namespace earshot::policy {

/// Where the cells' centres are once the source has drifted. A drift takes a row of cells north and a column east as a whole, and so does
/// an edge that it turns back at.
class CellPlaces {
 public:
  /// No grid that fits has more rows and columns together.
  static constexpr std::size_t kMostAxes = config::kMaxBeliefCells + 1;

  /// After so many measurements, from a corner that need not be the area's.
  void find(const BeliefModel& model, const Drift& drift, std::uint32_t measurements, NorthEast corner);

  /// Range from the vehicle to the centre of every cell, in range steps, rounded; at most the last.
  /// @param position  of the vehicle, from the same corner
  /// @param range_step  > 0
  /// @param last      the last range of the tables
  /// @param ranges    [north x east]; the result
  void find_ranges(const BeliefModel& model, NorthEast position, Meters range_step, std::size_t last,
                   std::span<std::uint16_t> ranges) const;

  /// The centre of a cell, from that corner. @param cell  index in [north x east]
  [[nodiscard]] NorthEast place(const BeliefModel& model, std::size_t cell) const;

  /// In which cell of the area at that corner the centre of every cell lies; outside, in the nearest.
  /// @param cells  [north x east]; the result
  void find_cells(const BeliefModel& model, std::span<std::uint16_t> cells) const;
  /// The same by rows and columns: the sum of a row's and a column's is the cell.
  /// @param axes  of the rows the first cell of the row in which they lie, and behind them of the columns the column; the result
  void find_axes(const BeliefModel& model, std::span<std::uint16_t> axes) const;

 private:
  /// Places of the rows, m, and behind them those of the columns.
  std::array<float, kMostAxes> places_;
};

}  // namespace earshot::policy
