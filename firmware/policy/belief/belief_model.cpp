#include "firmware/policy/belief/belief_model.hpp"

#include "firmware/core/math.hpp"
#include "firmware/policy/belief/search_bounds.hpp"

namespace earshot::policy {
namespace {

constexpr double kMostCost = 1e6;
/// Other costs are divided by the worth of a find probability.
constexpr double kLeastFindWorth = 1e-3;
/// Next to no step after the first counts.
constexpr double kLeastLogDiscount = -10.0;
/// A thousand steps count: with more, one less the discount is no number to divide by.
constexpr double kMostLogDiscount = -1e-3;

bool has_valid_numbers(const BeliefCosts& costs) {
  return is_within(double{costs.step}, 0.0, kMostCost) && is_within(double{costs.log_step_discount}, kLeastLogDiscount, kMostLogDiscount) &&
         is_within(double{costs.find_probability}, kLeastFindWorth, kMostCost) && is_within(double{costs.find_discount}, 0.0, 1.0) &&
         is_within(double{costs.edge}, 0.0, kMostCost) && is_within(double{costs.most_regret}, 0.0, kMostCost);
}

}  // namespace

bool has_valid_shape(const BeliefModel& model) {
  return model.cells_north >= 1 && model.cells_east >= 1 && cell_count(model) <= config::kMaxBeliefCells && !model.actions.empty();
}

bool has_valid_numbers(const BeliefModel& model) {
  const auto is_length = [](Meters x, double most) { return is_within(x.value, kLeastLength_m, most); };
  return is_length(model.area_size.north, kMostArea_m) && is_length(model.area_size.east, kMostArea_m) &&
         is_length(model.step_length, kMostStep_m) && is_length(model.border_width, kMostStep_m) &&
         is_finite(model.detection_threshold.value) && is_within(double{model.outlier_share}, 0.0, 1.0) && has_valid_numbers(model.costs);
}

}  // namespace earshot::policy
