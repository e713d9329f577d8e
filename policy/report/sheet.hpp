#pragma once

#include <optional>
#include <string>

#include "policy/report/recorded_flight.hpp"

namespace earshot::report {

/// One decision of one flight, explained.
struct Sheet {
  const RecordedFlight& flight;
  std::size_t index;  ///< of the decision
  explain::DecisionAccount account;

  [[nodiscard]] std::span<const explain::RecordedDecision> looks() const { return std::span(flight.journal.decisions).first(index + 1); }
};

[[nodiscard]] Sheet make_sheet(const RecordedFlight& flight, std::size_t index, explain::Baseline baseline);

/// "Step 12: why it went NE"
[[nodiscard]] std::string title_of(const Sheet& sheet);

[[nodiscard]] std::string as_html(const Sheet& sheet);  ///< a page that needs no other file; draws with gnuplot
[[nodiscard]] std::string as_markdown(const Sheet& sheet);
[[nodiscard]] std::string as_json(const Sheet& sheet);

}  // namespace earshot::report
