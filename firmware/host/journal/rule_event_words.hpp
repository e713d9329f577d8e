#pragma once

#include <string>

#include "firmware/messages/safety_event.hpp"

namespace earshot::host {

/// How many decimals it takes to tell a measure from its limit, 1 to 6: a battery that is told twice a second ends at 29.998, below 30.
[[nodiscard]] int decimals_apart(double measure, double limit);

/// A rule with its evidence: "rule 11, battery_percent: 14.9, below 15.0: return"; "rule 11, battery_percent: no longer"
[[nodiscard]] std::string to_string(const messages::SafetyEvent& event);

}  // namespace earshot::host
