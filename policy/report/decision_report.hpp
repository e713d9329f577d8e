#pragma once

#include <optional>
#include <string>

#include "policy/report/recorded_flight.hpp"

namespace earshot::report {

/// One decision of one flight, explained.
struct DecisionReport {
  const RecordedFlight& flight;
  std::size_t index;  ///< of the decision
  explain::DecisionAccount account;

  [[nodiscard]] std::span<const explain::RecordedDecision> measurements() const {
    return std::span(flight.journal.decisions).first(index + 1);
  }
};

[[nodiscard]] DecisionReport make_decision_report(const RecordedFlight& flight, std::size_t index, explain::Baseline baseline);

/// "Step 12: why it went NE"
[[nodiscard]] std::string title_of(const DecisionReport& report);

[[nodiscard]] std::string as_markdown(const DecisionReport& report);
[[nodiscard]] std::string as_json(const DecisionReport& report);

}  // namespace earshot::report
