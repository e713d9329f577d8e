#include "firmware/policy/belief.hpp"

#include <cassert>

#include "firmware/core/math.hpp"

namespace earshot::policy {

bool has_valid_shape(const BeliefModel& model) {
  const std::size_t cells = std::size_t{model.cells_north} * model.cells_east;
  return cells >= 1 && cells <= config::kMaxBeliefCells && !model.hypotheses.empty() && !model.snr_db.empty() && !model.actions.empty();
}

bool has_valid_numbers(const BeliefModel& model) {
  const auto is_positive = [](double x) { return is_finite(x) && x > 0.0; };
  const auto is_share = [](float x, float most) { return x >= 0.0F && x <= most; };
  for (const BeliefHypothesis& h : model.hypotheses) {
    if (!is_finite(h.level_offset_db) || !is_positive(double{h.spread_db}) || !is_positive(double{h.prior})) return false;
  }
  for (const float snr : model.snr_db) {
    if (!is_finite(snr)) return false;
  }
  return is_positive(model.area_size.north.value) && is_positive(model.area_size.east.value) && is_positive(model.step_length.value) &&
         is_positive(model.border_width.value) && is_positive(model.range_step.value) && is_finite(model.detection_threshold.value) &&
         is_share(model.outlier_share, 1.0F) && is_share(model.silence_share, 1.0F) && is_share(model.drift_share, 0.5F);
}

void Belief::start(const BeliefModel& model) {
  const std::size_t cells = std::size_t{model.cells_north} * model.cells_east;
  float sum = 0.0F;
  for (const BeliefHypothesis& hypothesis : model.hypotheses) sum += hypothesis.prior;
  for (std::size_t h = 0; h < model.hypotheses.size(); ++h) {
    hypothesis_shares_[h] = model.hypotheses[h].prior / sum;
    for (std::size_t i = 0; i < cells; ++i) planes_[h * cells + i] = hypothesis_shares_[h] / static_cast<float>(cells);
  }
  summary_ = {};
  outlooks_ = {};
}

void Belief::update(const BeliefModel& /*model*/, NorthEast /*position*/, Heard /*heard*/) {}

float Belief::probability(const BeliefModel& model, std::size_t north, std::size_t east) const {
  const std::size_t cells = std::size_t{model.cells_north} * model.cells_east;
  float sum = 0.0F;
  for (std::size_t h = 0; h < model.hypotheses.size(); ++h) sum += planes_[h * cells + north * model.cells_east + east];
  return sum;
}

}  // namespace earshot::policy
