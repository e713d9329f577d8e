#pragma once

#include <array>
#include <span>

#include "firmware/config/capacities.hpp"
#include "firmware/policy/belief_model.hpp"
#include "firmware/policy/ocean_belief/hypothesis_block.hpp"
#include "firmware/policy/reception.hpp"
#include "firmware/policy/tables/ocean_tables.hpp"

namespace earshot::policy {

/// Likelihoods of what was heard, were the source at each range, under the hypotheses of a block: log weights.
class LaneLikelihoods {
 public:
  /// Of a look.
  void tabulate(const BeliefModel& model, const OceanTables& tables, const std::array<Hypothesis, kLanes>& hypotheses, Reception reception);
  [[nodiscard]] std::span<const LogLanes> by_range(const OceanTables& tables) const { return std::span(lanes_).first(tables.range_count); }

 private:
  std::array<LogLanes, config::kMaxTableRanges> lanes_;
};

}  // namespace earshot::policy
