#include "firmware/policy/belief.hpp"

#include <algorithm>
#include <cassert>
#include <span>

#include "firmware/core/math.hpp"
#include "firmware/policy/normal_table.hpp"

namespace earshot::policy {
namespace {

constexpr float kOutlierRange = 80.0F;  // dB over which an SNR that follows no model is spread
constexpr float kCovered = 1e-3F;       // share left to a cell within step_length of a place visited: navigation errs, sources move
constexpr float kLeast = 1e-10F;        // probability that no cell goes below, so that it can come back

std::size_t cell_count(const BeliefModel& model) {
  return std::size_t{model.cells_north} * model.cells_east;
}

float cell_north(const BeliefModel& model) {
  return static_cast<float>(model.area_size.north.value / double{model.cells_north});
}

float cell_east(const BeliefModel& model) {
  return static_cast<float>(model.area_size.east.value / double{model.cells_east});
}

/// Sum in eight interleaved partial sums, added up pairwise: the order is fixed, and a vector unit of up to eight floats can follow it.
float sum_of(std::span<const float> values) {
  constexpr std::size_t kLanes = 8;
  std::array<float, kLanes> sums{};
  const std::size_t whole = values.size() - values.size() % kLanes;
  for (std::size_t i = 0; i < whole; i += kLanes) {
    for (std::size_t lane = 0; lane < kLanes; ++lane) sums[lane] += values[i + lane];
  }
  for (std::size_t i = whole; i < values.size(); ++i) sums[i - whole] += values[i];
  return ((sums[0] + sums[4]) + (sums[2] + sums[6])) + ((sums[1] + sums[5]) + (sums[3] + sums[7]));
}

/// Likelihood of what was heard if the model's SNR were `snr`.
float likelihood(const BeliefModel& model, const BeliefHypothesis& hypothesis, Heard heard, float snr) {
  const float excess = (static_cast<float>(heard.snr.value) - snr - hypothesis.level_offset_db) / hypothesis.spread_db;
  const float sounding = 1.0F - model.silence_share;
  const float regular = 1.0F - model.outlier_share;
  if (!heard.measured) return model.silence_share + sounding * (regular * normal_cumulative(excess) + model.outlier_share * 0.5F);
  return sounding * (regular * normal_density(excess) / hypothesis.spread_db + model.outlier_share / kOutlierRange);
}

using RangeTable = std::array<float, config::kMaxBeliefRanges>;

/// The same for every range, as a cell of half-width `half` range steps sees it: the mean over the cell.
void tabulate(const BeliefModel& model, const BeliefHypothesis& hypothesis, Heard heard, std::size_t half, RangeTable& table) {
  RangeTable exact;
  const std::size_t count = model.snr_db.size();
  for (std::size_t i = 0; i < count; ++i) exact[i] = likelihood(model, hypothesis, heard, model.snr_db[i]);
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t first = i < half ? 0 : i - half;
    const std::size_t last = std::min(i + half, count - 1);
    float sum = 0.0F;
    for (std::size_t k = first; k <= last; ++k) sum += exact[k];
    table[i] = sum / static_cast<float>(last - first + 1);
  }
}

/// Share of a cell of size `cell`, its centre at `range`, that lies further than `reach` from the vehicle.
float uncovered(float range, float reach, float cell) {
  return std::clamp((range - reach) / cell + 0.5F, kCovered, 1.0F);
}

}  // namespace

bool has_valid_shape(const BeliefModel& model) {
  return model.cells_north >= 1 && model.cells_east >= 1 && cell_count(model) <= config::kMaxBeliefCells && !model.hypotheses.empty() &&
         !model.snr_db.empty() && !model.actions.empty();
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
  const std::size_t cells = cell_count(model);
  float sum = 0.0F;
  for (const BeliefHypothesis& hypothesis : model.hypotheses) sum += hypothesis.prior;
  for (std::size_t h = 0; h < model.hypotheses.size(); ++h) {
    hypothesis_shares_[h] = model.hypotheses[h].prior / sum;
    std::fill_n(planes_.begin() + static_cast<std::ptrdiff_t>(h * cells), cells, hypothesis_shares_[h] / static_cast<float>(cells));
  }
  std::fill_n(marginal_.begin(), cells, 1.0F / static_cast<float>(cells));
  const auto stride = std::max<std::size_t>(1, static_cast<std::size_t>(model.step_length / model.range_step + 0.5));
  for (std::size_t i = 0; i < model.snr_db.size(); ++i) {
    const bool heard = double{model.snr_db[i]} >= model.detection_threshold.value;
    cost_[i] = i <= stride ? 0.0F : (heard ? 0.0F : 1.0F) + 0.2F + cost_[i - stride];
  }
}

void Belief::update(const BeliefModel& model, NorthEast position, Heard heard) {
  find_cells(model, position);
  weigh(model, heard);
  normalise(model);
  summarise(model);
  look_out(model, position);
}

void Belief::find_cells(const BeliefModel& model, NorthEast position) {
  const float per_step = static_cast<float>(1.0 / model.range_step.value);
  const float size_north = cell_north(model) * per_step;
  const float size_east = cell_east(model) * per_step;
  const float vehicle_north = static_cast<float>(position.north.value) * per_step;
  const float vehicle_east = static_cast<float>(position.east.value) * per_step;
  const auto last = static_cast<float>(model.snr_db.size() - 1);
  for (std::size_t n = 0; n < model.cells_north; ++n) {
    const float north = (static_cast<float>(n) + 0.5F) * size_north - vehicle_north;
    std::uint16_t* const row = &bins_[n * model.cells_east];
    for (std::size_t e = 0; e < model.cells_east; ++e) {
      const float east = (static_cast<float>(static_cast<int>(e)) + 0.5F) * size_east - vehicle_east;
      const float range = __builtin_sqrtf(north * north + east * east);
      row[e] = static_cast<std::uint16_t>(static_cast<int>((range < last ? range : last) + 0.5F));
    }
  }
}

void Belief::weigh(const BeliefModel& model, Heard heard) {
  const std::size_t cells = cell_count(model);
  const float cell = std::max(cell_north(model), cell_east(model));
  const auto half = static_cast<std::size_t>(0.5F * cell / static_cast<float>(model.range_step.value));
  RangeTable table;
  for (std::size_t h = 0; h < model.hypotheses.size(); ++h) {
    tabulate(model, model.hypotheses[h], heard, half, table);
    for (std::size_t i = 0; i < model.snr_db.size(); ++i) {
      table[i] *= uncovered(static_cast<float>(i) * static_cast<float>(model.range_step.value), static_cast<float>(model.step_length.value), cell);
    }
    float* const plane = &planes_[h * cells];
    for (std::size_t i = 0; i < cells; ++i) plane[i] *= table[bins_[i]];
  }
}

void Belief::normalise(const BeliefModel& model) {
  const std::size_t cells = cell_count(model);
  float total = 0.0F;
  for (std::size_t h = 0; h < model.hypotheses.size(); ++h) {
    hypothesis_shares_[h] = sum_of(std::span(planes_).subspan(h * cells, cells));
    total += hypothesis_shares_[h];
  }
  const float scale = 1.0F / total;
  std::fill_n(marginal_.begin(), cells, 0.0F);
  for (std::size_t h = 0; h < model.hypotheses.size(); ++h) {
    hypothesis_shares_[h] *= scale;
    float* const plane = &planes_[h * cells];
    for (std::size_t i = 0; i < cells; ++i) {
      const float p = plane[i] * scale;
      plane[i] = p > kLeast ? p : kLeast;
      marginal_[i] += plane[i];
    }
  }
}

}  // namespace earshot::policy
