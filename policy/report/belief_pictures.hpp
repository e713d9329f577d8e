#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "firmware/core/geometry.hpp"
#include "policy/explain/decision_account.hpp"

namespace earshot::report {

/// One chart: where the source is believed to be when the decision is taken.
struct BeliefPicture {
  const explain::DecisionAccount& account;
  std::span<const explain::RecordedDecision> measurements;  ///< up to this decision, the track in its corners
  std::optional<NorthEast> source;                          ///< where only a simulator knows that it is
};

/// Draws the charts with one gnuplot; each is SVG text that may stand in a page. @throws std::runtime_error when gnuplot fails.
[[nodiscard]] std::vector<std::string> belief_svgs(const std::vector<BeliefPicture>& pictures);

}  // namespace earshot::report
