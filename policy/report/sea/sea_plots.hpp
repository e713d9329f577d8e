#pragma once

#include <string>
#include <vector>

#include "policy/explain/recorded_decision.hpp"
#include "policy/report/sea/sea_flight.hpp"

namespace earshot::report {

// Pictures of a flight that only its journal tells of, as SVG text to stand in a page. @throws std::runtime_error when gnuplot fails.

/// The track by the vehicle's own navigation, decisions, start and end; "" without a fix.
[[nodiscard]] std::string sea_map_svg(const SeaFlight& flight, const std::vector<explain::RecordedDecision>& decisions);

/// The SNR that came in, against time, with the detection threshold; "" when none came.
[[nodiscard]] std::string sea_history_svg(const SeaFlight& flight, const std::vector<explain::RecordedDecision>& decisions);

}  // namespace earshot::report
