#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "policy/explain/decision_account.hpp"
#include "policy/explain/recorded_decision.hpp"

namespace earshot::report {

/// A `Decision` of the page.
/// @param time_s   since the journal's first record
/// @param account  nothing: it is not explained, and has neither reasons nor a belief
[[nodiscard]] nlohmann::ordered_json decision_value(double time_s, const explain::RecordedDecision& decision,
                                                    const std::optional<explain::DecisionAccount>& account);

/// The probability of all cells that are likelier than a cell, as a byte: 0 of the likeliest, near 255 of those that together hold next to
/// nothing. @return [north x east]
[[nodiscard]] std::vector<std::uint8_t> area_of_cells(const std::vector<double>& probability);

}  // namespace earshot::report
