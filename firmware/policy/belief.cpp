#include "firmware/policy/belief.hpp"

#include <algorithm>
#include <bit>
#include <cassert>
#include <span>

#include "firmware/core/crc32.hpp"
#include "firmware/core/math.hpp"
#include "firmware/core/wide.hpp"
#include "firmware/policy/bearing_likelihood.hpp"
#include "firmware/policy/belief_summary.hpp"
#include "firmware/policy/normal_table.hpp"

namespace earshot::policy {
namespace {

/// Decibels over which an SNR that follows no model is spread.
constexpr float kOutlierRange_db = 80.0F;
/// Share of its probability that a cell within step_length of a place visited keeps: navigation errs, sources move.
constexpr float kCovered = 1e-3F;

double cell_north(const BeliefModel& model) {
  return model.area_size.north.value / static_cast<double>(model.cells_north);
}

double cell_east(const BeliefModel& model) {
  return model.area_size.east.value / static_cast<double>(model.cells_east);
}

using RangeTable = std::array<float, config::kMaxBeliefRanges>;

/// Likelihood of what was heard, were the source at each range, under one hypothesis.
void tabulate_likelihood(const BeliefModel& model, const BeliefHypothesis& hypothesis, Reception reception, RangeTable& table) {
  const float sounding = 1.0F - model.silence_share;
  const float regular = sounding * (1.0F - model.outlier_share);
  const float per_spread = 1.0F / hypothesis.spread_db;
  const float level = static_cast<float>(reception.snr.value) - hypothesis.level_offset_db;
  const std::span<float> likelihoods = std::span(table).first(model.snr_db.size());
  for (std::size_t i = 0; i < likelihoods.size(); ++i) likelihoods[i] = (level - model.snr_db[i]) * per_spread;
  if (!reception.too_faint) {
    const float outlier = sounding * model.outlier_share / kOutlierRange_db;
    const float scale = regular * per_spread;
    to_normal_density(likelihoods);
    for (float& likelihood : likelihoods) likelihood = scale * likelihood + outlier;
  } else {
    const float outlier = model.silence_share + sounding * model.outlier_share * 0.5F;
    to_normal_cumulative(likelihoods);
    for (float& likelihood : likelihoods) likelihood = regular * likelihood + outlier;
  }
}

/// Mean over the `half` samples to either side of each; beyond the ends the first and the last hold.
void smooth(std::span<const float> values, std::size_t half, std::span<float> smoothed) {
  const std::size_t count = values.size();
  const float share = 1.0F / static_cast<float>(2 * half + 1);
  const auto held = [&](std::size_t i) {  // at the ends
    float sum = 0.0F;
    for (std::size_t k = 0; k <= 2 * half; ++k) sum += values[std::clamp(i + k, half, count - 1 + half) - half];
    return sum * share;
  };
  const std::size_t last = count > 2 * half ? count - half : half;
  for (std::size_t i = 0; i < std::min(half, count); ++i) smoothed[i] = held(i);
  // Sample by sample of the mean, so that a vector unit can take many means at once.
  for (std::size_t i = half; i < last; ++i) smoothed[i] = values[i - half];
  for (std::size_t k = 1; k <= 2 * half; ++k) {
    for (std::size_t i = half; i < last; ++i) smoothed[i] += values[i - half + k];
  }
  for (std::size_t i = half; i < last; ++i) smoothed[i] *= share;
  for (std::size_t i = last; i < count; ++i) smoothed[i] = held(i);
}

/// Range steps in half a cell: a likelihood is smoothed by as much, for a cell lies at many ranges at once.
std::size_t half_cell(const BeliefModel& model) {
  const double cell = std::max(cell_north(model), cell_east(model));
  return std::min(static_cast<std::size_t>(0.5 * cell / model.range_step.value), model.snr_db.size() - 1);
}

/// Share of a cell of size `cell`, its centre at `range`, that lies further than `reach` from the vehicle.
float uncovered(float range, float reach, float cell) {
  return std::clamp((range - reach) / cell + 0.5F, kCovered, 1.0F);
}

}  // namespace

void Belief::start(const BeliefModel& model) {
  const std::size_t cells = cell_count(model);
  const std::size_t hypotheses = model.hypotheses.size();
  float sum = 0.0F;
  for (const BeliefHypothesis& hypothesis : model.hypotheses) sum += hypothesis.prior;
  priors_ = {};
  for (std::size_t h = 0; h < hypotheses; ++h) priors_[h] = model.hypotheses[h].prior / sum;
  begin_anew(cells);
}

void Belief::begin_anew(std::size_t cells) {
  hypothesis_shares_ = priors_;
  Cell each;
  for (std::size_t h = 0; h < each.size(); ++h) each[h] = priors_[h] / static_cast<float>(cells);
  std::fill_n(cells_.begin(), cells, each);
  std::fill_n(marginal_.begin(), cells, 1.0F / static_cast<float>(cells));
}

/// Tabulates by range the cost of a search that goes straight to a source, under the hypotheses as likely as they now are.
EARSHOT_WIDE void Belief::foresee(const BeliefModel& model) {
  const std::size_t count = model.snr_db.size();
  RangeTable over_all{};
  RangeTable detected;  // under one hypothesis
  for (std::size_t h = 0; h < model.hypotheses.size(); ++h) {
    const BeliefHypothesis& hypothesis = model.hypotheses[h];
    const float per_spread = 1.0F / hypothesis.spread_db;
    const float level = hypothesis.level_offset_db - static_cast<float>(model.detection_threshold.value);
    const float share = (1.0F - model.silence_share) * hypothesis_shares_[h];
    for (std::size_t i = 0; i < count; ++i) detected[i] = (model.snr_db[i] + level) * per_spread;
    to_normal_cumulative(std::span(detected).first(count));
    for (std::size_t i = 0; i < count; ++i) over_all[i] += share * detected[i];
  }
  smooth(std::span(over_all).first(count), half_cell(model), detected_);
  const auto step = std::clamp<std::size_t>(static_cast<std::size_t>(model.step_length / model.range_step + 0.5), 1, count);
  const float discount = exp(model.costs.log_step_discount / static_cast<float>(step));
  const float discounted_away = 1.0F - exp(model.costs.log_step_discount);
  float discounted = 1.0F;
  RangeTable silent;  // expected steps without detection
  for (std::size_t i = 0; i < count; ++i) {
    silent[i] = 0.0F;
    if (i > step) {
      const float steps = static_cast<float>(i - step) / static_cast<float>(step);
      silent[i] = (1.0F - detected_[i]) * std::min(1.0F, steps) + silent[i - step];
      discounted *= discount;
    }
    search_cost_[i] = silent[i] + model.costs.step * (1.0F - discounted) / discounted_away;
  }
}

std::uint32_t Belief::fingerprint(const BeliefModel& model) const {
  static_assert(std::endian::native == std::endian::little);
  const auto bytes_of = [](const auto* first, std::size_t count) {
    return std::span(reinterpret_cast<const std::uint8_t*>(first), count * sizeof(*first));
  };
  const std::uint32_t of_cells = crc32(bytes_of(cells_.data(), cell_count(model)));
  return crc32(bytes_of(outlooks_.data(), model.actions.size()), of_cells);
}

void Belief::update(const BeliefModel& model, NorthEast position, Reception reception) {
  find_ranges(model, position);
  if (reception.bearing) weigh_bearing(model, position, *reception.bearing);
  weigh(model, reception);
  foresee(model);
  const std::span<const float> probabilities = std::span(marginal_).first(cell_count(model));
  summary_ = summary_of(model, probabilities);
  const std::size_t ranges = model.snr_db.size();
  find_outlooks(model, probabilities, {std::span(search_cost_).first(ranges), std::span(detected_).first(ranges)}, position,
                std::span(outlooks_).first(model.actions.size()));
}

EARSHOT_WIDE void Belief::find_ranges(const BeliefModel& model, NorthEast position) {
  const auto size_north = static_cast<float>(cell_north(model) / model.range_step.value);
  const auto size_east = static_cast<float>(cell_east(model) / model.range_step.value);
  const auto vehicle_north = static_cast<float>(position.north / model.range_step);
  const auto vehicle_east = static_cast<float>(position.east / model.range_step);
  const auto last = static_cast<float>(model.snr_db.size() - 1);
  const int columns = model.cells_east;  // a copy: what is written below could otherwise be it
  for (std::size_t n = 0; n < model.cells_north; ++n) {
    const float north = (static_cast<float>(n) + 0.5F) * size_north - vehicle_north;
    std::uint16_t* const row = &ranges_[n * model.cells_east];
    for (int e = 0; e < columns; ++e) {
      const float east = (static_cast<float>(e) + 0.5F) * size_east - vehicle_east;
      const float range = __builtin_sqrtf(north * north + east * east);
      row[e] = static_cast<std::uint16_t>(static_cast<int>((range < last ? range : last) + 0.5F));
    }
  }
}

/// Whatever the hypothesis; the sum of the cells is weigh()'s to mend.
void Belief::weigh_bearing(const BeliefModel& model, NorthEast position, const messages::Bearing& bearing) {
  const NorthEast cell{.north = Meters{cell_north(model)}, .east = Meters{cell_east(model)}};
  const BearingLikelihood likelihood(bearing, std::max(cell.north, cell.east), model.outlier_share);
  for (std::size_t n = 0; n < model.cells_north; ++n) {
    const Meters north = (static_cast<double>(n) + 0.5) * cell.north - position.north;
    for (std::size_t e = 0; e < model.cells_east; ++e) {
      const float factor = likelihood.at({.north = north, .east = (static_cast<double>(e) + 0.5) * cell.east - position.east});
      for (float& p : cells_[n * model.cells_east + e]) p *= factor;
    }
  }
}

EARSHOT_WIDE void Belief::weigh(const BeliefModel& model, Reception reception) {
  const std::size_t count = model.snr_db.size();
  const auto cell = static_cast<float>(std::max(cell_north(model), cell_east(model)));
  const auto range_step = static_cast<float>(model.range_step.value);
  const auto reach = static_cast<float>(model.step_length.value);
  std::array<Cell, config::kMaxBeliefRanges> tables{};  // by range, then hypothesis, as the cells are
  RangeTable exact;
  RangeTable seen;
  for (std::size_t h = 0; h < model.hypotheses.size(); ++h) {
    tabulate_likelihood(model, model.hypotheses[h], reception, exact);
    smooth(std::span(exact).first(count), half_cell(model), seen);
    for (std::size_t i = 0; i < count; ++i) tables[i][h] = seen[i] * uncovered(static_cast<float>(i) * range_step, reach, cell);
  }
  Cell sums{};
  for (std::size_t i = 0; i < cell_count(model); ++i) {
    const Cell& likelihood = tables[ranges_[i]];
    for (std::size_t h = 0; h < likelihood.size(); ++h) {
      cells_[i][h] *= likelihood[h];
      sums[h] += cells_[i][h];
    }
  }
  normalise(model, sums);
}

EARSHOT_WIDE void Belief::normalise(const BeliefModel& model, const Cell& sums) {
  const std::size_t cells = cell_count(model);
  const float total = (sums[0] + sums[1]) + (sums[2] + sums[3]);
  const float forgotten = model.forgotten_share;
  const float remembered = (1.0F - forgotten) / total;
  if (!(total > 0.0F) || !is_finite(total) || !is_finite(remembered)) {  // what cannot be has been heard
    begin_anew(cells);
    return;
  }
  Cell fresh;  // of the forgotten share, the part of one cell
  for (std::size_t h = 0; h < sums.size(); ++h) {
    hypothesis_shares_[h] = remembered * sums[h] + forgotten * priors_[h];
    fresh[h] = forgotten * priors_[h] / static_cast<float>(cells);
  }
  for (std::size_t i = 0; i < cells; ++i) {
    Cell& p = cells_[i];
    for (std::size_t h = 0; h < p.size(); ++h) p[h] = p[h] * remembered + fresh[h];
    marginal_[i] = (p[0] + p[1]) + (p[2] + p[3]);
  }
}

}  // namespace earshot::policy
