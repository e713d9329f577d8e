#include "firmware/policy/ocean_belief/hypotheses/lane_likelihoods.hpp"

#include <algorithm>

#include "firmware/core/wide.hpp"
#include "firmware/policy/likelihood/belief_grid.hpp"
#include "firmware/policy/likelihood/reception_likelihood.hpp"
#include "firmware/policy/ocean_belief/log_weight/log_weight.hpp"

namespace earshot::policy {
namespace {

/// Whether two differ in nothing but how the source moves.
bool hears_the_same(const Hypothesis& a, const Hypothesis& b) {
  return a.table == b.table && a.level == b.level && a.spread == b.spread && a.silence == b.silence;
}

}  // namespace

EARSHOT_WIDE void LaneLikelihoods::tabulate(const BeliefModel& model, const OceanTables& tables,
                                            const std::array<Hypothesis, kLanes>& hypotheses, Reception reception, std::size_t count) {
  count_ = count;
  const std::size_t half = half_cell(model, tables.range_step, tables.range_count);
  const std::size_t smoothed = std::min(count + half, std::size_t{tables.range_count});  // what a cell at the last range lies at as well
  std::array<float, config::kMaxTableRanges> exact_room;
  std::array<float, config::kMaxTableRanges> seen_room;
  std::array<std::int16_t, config::kMaxTableRanges> logs_room;
  const std::span<float> exact = std::span(exact_room).first(smoothed);
  const std::span<float> seen = std::span(seen_room).first(smoothed);
  const std::span<std::int16_t> logs = std::span(logs_room).first(count);
  for (std::size_t l = 0; l < kLanes; ++l) {
    const Hypothesis& h = hypotheses[l];
    std::size_t alike = 0;
    while (!hears_the_same(h, hypotheses[alike])) ++alike;
    if (alike < l) {
      for (std::size_t i = 0; i < count; ++i) raised_[i][l] = raised_[i][alike];
      continue;
    }
    const OceanTable& table = tables.tables[h.table];
    for (std::size_t i = 0; i < smoothed; ++i) exact[i] = table.snr_db(i);
    to_likelihoods({kLevelOffsets_db[h.level], kSpreads_db[h.spread], kSilenceShares[h.silence], model.outlier_share}, reception, exact);
    smooth(exact, half, seen);
    to_logs(seen.first(count), kLeastLogLikelihood, logs);
    for (std::size_t i = 0; i < count; ++i) raised_[i][l] = static_cast<std::int16_t>(tempered(logs[i]) - kLeastLogLikelihood);
  }
}

}  // namespace earshot::policy
