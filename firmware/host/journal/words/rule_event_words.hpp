#pragma once

#include <string>

#include "firmware/host/text/text_line.hpp"
#include "firmware/messages/safety_event.hpp"

namespace earshot::journal {

/// How many decimals it takes to tell a measure from its limit, 1 to 6: a battery that is told twice a second ends at 29.998, below 30.
[[nodiscard]] int decimals_apart(double measure, double limit);

/// A rule with its evidence: "rule 11, battery_percent: 14.9, below 15.0: return"; "rule 11, battery_percent: no longer";
/// "rule 14, setpoints_unsent_s: no set-point could be sent for 10.2 s, above 10.0: abort; check the port's bus and its address"
[[nodiscard]] std::string to_string(const messages::SafetyEvent& event);
/// Likewise, into memory of the caller's; allocates nothing.
void write_rule(host::TextInto& line, const messages::SafetyEvent& event);

}  // namespace earshot::journal
