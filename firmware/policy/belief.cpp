#include "firmware/policy/belief.hpp"

#include <algorithm>
#include <bit>
#include <cassert>
#include <span>

#include "firmware/core/crc32.hpp"
#include "firmware/core/math.hpp"
#include "firmware/core/wide.hpp"
#include "firmware/policy/belief_summary.hpp"
#include "firmware/policy/likelihood/bearing_likelihood.hpp"
#include "firmware/policy/likelihood/belief_grid.hpp"
#include "firmware/policy/likelihood/normal_table.hpp"
#include "firmware/policy/likelihood/reception_likelihood.hpp"

namespace earshot::policy {
namespace {

using RangeTable = std::array<float, config::kMaxBeliefRanges>;

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
  smooth(std::span(over_all).first(count), half_cell(model, count), detected_);
  find_search_cost(model, 1.0F, std::span(detected_).first(count), std::span(search_cost_).first(count));
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
  find_ranges(model, position, model.snr_db.size() - 1, ranges_);
  if (reception.bearing) weigh_bearing(model, position, *reception.bearing);
  weigh(model, reception);
  foresee(model);
  const std::span<const float> probabilities = std::span(marginal_).first(cell_count(model));
  summary_ = summary_of(model, probabilities);
  const std::size_t ranges = model.snr_db.size();
  find_outlooks(model, probabilities, {std::span(search_cost_).first(ranges), std::span(detected_).first(ranges)}, position,
                std::span(outlooks_).first(model.actions.size()));
}

/// Whatever the hypothesis; the sum of the cells is weigh()'s to mend.
void Belief::weigh_bearing(const BeliefModel& model, NorthEast position, const messages::Bearing& bearing) {
  const BearingLikelihood likelihood(bearing, Meters{std::max(cell_north(model), cell_east(model))}, model.outlier_share);
  for (std::size_t i = 0; i < cell_count(model); ++i) {
    const float factor = likelihood.at(way_to_cell(model, position, i));
    for (float& p : cells_[i]) p *= factor;
  }
}

EARSHOT_WIDE void Belief::weigh(const BeliefModel& model, Reception reception) {
  const std::size_t count = model.snr_db.size();
  std::array<Cell, config::kMaxBeliefRanges> tables{};  // by range, then hypothesis, as the cells are
  RangeTable exact;
  RangeTable seen;
  RangeTable uncovered;
  find_uncovered(model, std::span(uncovered).first(count));
  for (std::size_t h = 0; h < model.hypotheses.size(); ++h) {
    const BeliefHypothesis& hypothesis = model.hypotheses[h];
    std::copy_n(model.snr_db.begin(), count, exact.begin());
    to_likelihoods({hypothesis.level_offset_db, hypothesis.spread_db, model.silence_share, model.outlier_share}, reception,
                   std::span(exact).first(count));
    smooth(std::span(exact).first(count), half_cell(model, count), seen);
    for (std::size_t i = 0; i < count; ++i) tables[i][h] = seen[i] * uncovered[i];
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
