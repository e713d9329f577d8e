#include "firmware/policy/ocean_belief/lane_likelihoods.hpp"

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
                                            const std::array<Hypothesis, kLanes>& hypotheses, Reception reception) {
  const std::size_t count = tables.range_count;
  using RangeTable = std::array<float, config::kMaxTableRanges>;
  RangeTable exact;
  RangeTable seen;
  std::array<std::int16_t, config::kMaxTableRanges> logs;
  for (std::size_t l = 0; l < kLanes; ++l) {
    const Hypothesis& h = hypotheses[l];
    std::size_t alike = 0;
    while (!hears_the_same(h, hypotheses[alike])) ++alike;
    if (alike < l) {
      for (std::size_t i = 0; i < count; ++i) raised_[i][l] = raised_[i][alike];
      continue;
    }
    const OceanTable& table = tables.tables[h.table];
    for (std::size_t i = 0; i < count; ++i) exact[i] = table.snr_db(i);
    to_likelihoods({kLevelOffsets_db[h.level], kSpreads_db[h.spread], kSilenceShares[h.silence], model.outlier_share}, reception,
                   std::span(exact).first(count));
    smooth(std::span(exact).first(count), half_cell(model, tables.range_step, count), std::span(seen).first(count));
    to_logs(std::span(seen).first(count), kLeastLogLikelihood, std::span(logs).first(count));
    for (std::size_t i = 0; i < count; ++i) raised_[i][l] = static_cast<std::int16_t>(tempered(logs[i]) - kLeastLogLikelihood);
  }
}

}  // namespace earshot::policy
