#include "policy/explain/decision_follower.hpp"

namespace earshot::explain {

DecisionFollower::DecisionFollower(const Circumstances& circumstances)
    : circumstances_(circumstances), memory_(std::make_unique<policy::SearchMemory>()) {
  if (!circumstances.belief_is_the_policys) observers_belief_ = std::make_unique<policy::OceanBelief>();
}

void DecisionFollower::follow(const RecordedDecision& decision) {
  const Circumstances& c = circumstances_;
  const policy::ObservationModel& model = c.policy.observation;
  const NorthEast place = decision.position - c.south_west;
  if (decision.step == 0)
    memory_->start(model, c.tables, place, decision.reception());
  else
    memory_->remember(model, c.tables, place, decision.reception());
  if (!observers_belief_) return;
  if (decision.step == 0) observers_belief_->start(c.belief, c.tables);
  observers_belief_->update(c.belief, c.tables, place, decision.reception());
}

Contradiction DecisionFollower::contradiction(const RecordedDecision& last) const {
  return explain::contradiction(circumstances_.policy, last, *memory_);
}

DecisionAccount DecisionFollower::account_of(const RecordedDecision& last) const {
  return explain::account_of(circumstances_, last, belief());
}

const policy::OceanBelief& DecisionFollower::belief() const {
  return observers_belief_ ? *observers_belief_ : memory_->belief();
}

}  // namespace earshot::explain
