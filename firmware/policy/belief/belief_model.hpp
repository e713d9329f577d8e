#pragma once

#include <cstddef>
#include <cstdint>

#include "firmware/config/capacities.hpp"
#include "firmware/core/fixed_vector.hpp"
#include "firmware/core/geometry.hpp"
#include "firmware/core/units.hpp"

namespace earshot::policy {

/// What a search costs, for the action values; a step on which nothing is detected costs one. The defaults are the paper's search.
struct BeliefCosts {
  float step = 3.0F;  ///< of a step, the first of many, 0 to 1e6
  /// ln of what each step after it costs of the one before, -10 to -1e-3: a likely source near by is worth more than two half as likely
  /// further away. The default is ln 0.9.
  float log_step_discount = -0.105360516F;
  float find_probability = 30.0F;  ///< what a find probability of one is worth, 1e-3 to 1e6
  float find_discount = 0.85F;     ///< of a find probability that is one step further away, 0 to 1
  float edge = 100.0F;             ///< of the border at the edge itself, 0 to 1e6: -p of the paper's reward
  float most_regret = 10.0F;       ///< no regret counts for more, 0 to 1e6
  friend constexpr bool operator==(const BeliefCosts&, const BeliefCosts&) = default;
};

/// What a belief takes for granted of the search, whatever the ocean (that is in OceanTables); travels in the `.policy` file. Used only by
/// observations that see a belief.
struct BeliefModel {
  // The search; in a FrozenPolicy the same as its own.
  NorthEast area_size;          ///< the source lies in the area, both > 0
  Meters step_length{1'000.0};  ///< within it of the source the search ends
  Decibels detection_threshold{10.0};
  FixedVector<UnitNorthEast, config::kMaxActions> actions;
  Meters border_width{1'000.0};  ///< of the edge that a policy had better not enter, > 0
  BeliefCosts costs;

  std::uint16_t cells_north = 50;  ///< cells_north * cells_east <= kMaxBeliefCells
  std::uint16_t cells_east = 50;
  /// Share of SNRs that follow no model, 0 to 1.
  float outlier_share = 0.02F;
};

/// Cells of the belief's grid.
[[nodiscard]] inline std::size_t cell_count(const BeliefModel& model) {
  return std::size_t{model.cells_north} * model.cells_east;
}

/// Whether every size fits its capacity and is not zero.
[[nodiscard]] bool has_valid_shape(const BeliefModel& model);
/// Whether every number is in its range: step and border 1 m to 1000 km, area 1 m to 10 000 km, shares and costs as said at each.
/// @param model  of a valid shape
[[nodiscard]] bool has_valid_numbers(const BeliefModel& model);

}  // namespace earshot::policy
