#pragma once

#include <span>

#include "firmware/messages/decision.hpp"
#include "firmware/policy/belief/reception.hpp"

namespace earshot::explain {

/// A decision as the vehicle wrote it down, and what the search before it adds.
struct RecordedDecision : messages::Decision {
  bool was_mismatched = false;  ///< then, or before in this search

  [[nodiscard]] double time_s() const { return static_cast<double>(time.us) * 1e-6; }
  [[nodiscard]] policy::Reception reception() const { return {.snr = snr, .too_faint = too_faint, .bearing = bearing}; }
  /// The elements that the policy saw.
  [[nodiscard]] std::span<const float> observed() const { return messages::counted(observation, observation_size); }
  /// One for each of the policy's actions.
  [[nodiscard]] std::span<const float> action_logits() const { return messages::counted(logits, action_count); }
  /// 0 without a belief.
  [[nodiscard]] float mismatch_bits() const { return belief ? belief->mismatch_bits : 0.0F; }
};

}  // namespace earshot::explain
