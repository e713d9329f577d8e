#pragma once

#include <memory>

#include "policy/explain/decision_account.hpp"
#include "policy/explain/replay.hpp"

namespace earshot::explain {

/// Explains decisions as they come: each costs itself alone, for what was believed before is remembered.
class DecisionFollower {
 public:
  /// @param circumstances  what they refer to outlives this
  explicit DecisionFollower(const Circumstances& circumstances);

  /// The next decision; that of step 0 begins a search, and the others follow it without a gap.
  void follow(const RecordedDecision& decision);

  /// How the decision that was followed last contradicts the policy.
  [[nodiscard]] Contradiction contradiction(const RecordedDecision& last) const;
  /// What explains the decision that was followed last.
  [[nodiscard]] DecisionAccount account_of(const RecordedDecision& last) const;
  /// After it.
  [[nodiscard]] const policy::OceanBelief& belief() const;

 private:
  Circumstances circumstances_;
  std::unique_ptr<policy::SearchMemory> memory_;
  std::unique_ptr<policy::OceanBelief> observers_belief_;  ///< of a policy that holds none
};

}  // namespace earshot::explain
