#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "firmware/config/capacities.hpp"
#include "firmware/policy/belief/belief_model.hpp"
#include "firmware/policy/belief/reception.hpp"
#include "firmware/policy/ocean_belief/hypotheses/hypothesis_block.hpp"
#include "firmware/policy/tables/ocean_tables.hpp"

namespace earshot::policy {

/// Of the log likelihood of a measurement so much counts: two measurements near each other err alike where the table is wrong, and would
/// together be too sure of a wrong place or ocean were they taken for two that know nothing of one another (README.md has what was
/// measured).
inline constexpr int kTrust_256ths = 208;

/// @param log_likelihood  of a measurement, log weight   @return what of it counts
[[nodiscard]] constexpr int tempered(int log_likelihood) {
  return log_likelihood * kTrust_256ths / 256;
}

/// Likelihoods of what was heard, were the source at each range, under the hypotheses of a block: log weights, tempered.
class LaneLikelihoods {
 public:
  /// Of a measurement. @param count  of the tables' ranges, from the nearest, at least one: what is beyond them is taken to lie at the last
  void tabulate(const BeliefModel& model, const OceanTables& tables, const std::array<Hypothesis, kLanes>& hypotheses, Reception reception,
                std::size_t count);
  /// [count], raised by -kLeastLogLikelihood as HypothesisBlock::weigh() takes them.
  [[nodiscard]] std::span<const LogLanes> raised_by_range() const { return std::span(raised_).first(count_); }

 private:
  std::size_t count_ = 0;
  std::array<LogLanes, config::kMaxTableRanges> raised_;
};

}  // namespace earshot::policy
