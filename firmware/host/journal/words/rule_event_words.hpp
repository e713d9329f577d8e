#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "firmware/config/safety.hpp"
#include "firmware/messages/safety_event.hpp"

namespace earshot::journal {

/// How many decimals it takes to tell a measure from its limit, 1 to 6: a battery that is told twice a second ends at 29.998, below 30.
[[nodiscard]] int decimals_apart(double measure, double limit);

/// What a measure says, where a number beside its limit says too little: what stands before and behind it, and where to look.
struct MeasureWords {
  std::string_view before;
  std::string_view behind;
  std::string_view hint;
};
/// Nothing: "310.0, above 300.0" says it.
[[nodiscard]] std::optional<MeasureWords> words_of_measure(config::Condition condition);

/// Whether its limit says anything: not of a flag, nor where the words say "further than" and the limit is zero.
[[nodiscard]] bool names_limit(const messages::SafetyEvent& event);

/// A rule with its evidence: "rule 11, battery_percent: 14.9, below 15.0: return"; "rule 11, battery_percent: no longer";
/// "rule 14, setpoints_unsent_s: no set-point could be sent for 10.2 s, above 10.0: abort; check the port's bus and its address"
[[nodiscard]] std::string to_string(const messages::SafetyEvent& event);

}  // namespace earshot::journal
