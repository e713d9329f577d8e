#include "policy/explain/replay.hpp"

#include <algorithm>
#include <cassert>
#include <vector>

namespace earshot::explain {

std::unique_ptr<policy::SearchMemory> remembered_at(const policy::ObservationModel& model, const policy::OceanTables& tables,
                                                    std::span<const RecordedDecision> decisions, NorthEast south_west) {
  assert(!decisions.empty());
  auto memory = std::make_unique<policy::SearchMemory>();
  memory->start(model, tables, decisions.front().position - south_west, decisions.front().reception());
  for (const RecordedDecision& decision : decisions.subspan(1))
    memory->remember(model, tables, decision.position - south_west, decision.reception());
  return memory;
}

Contradiction contradiction(const policy::FrozenPolicy& policy, const RecordedDecision& decision, const policy::SearchMemory& memory) {
  if (decision.observed().size() != policy.observation.spec.size() || decision.action_logits().size() != policy.actions.size() ||
      decision.action >= policy.actions.size())
    return Contradiction::kSizes;
  std::vector<float> again(decision.action_logits().size());
  policy::find_logits(policy, decision.observed(), again);
  if (!std::ranges::equal(again, decision.action_logits())) return Contradiction::kLogits;
  again.resize(decision.observed().size());
  policy::observe(memory, policy.observation, again);
  return std::ranges::equal(again, decision.observed()) ? Contradiction::kNone : Contradiction::kObservation;
}

}  // namespace earshot::explain
