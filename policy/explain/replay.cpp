#include "policy/explain/replay.hpp"

#include <algorithm>
#include <cassert>

namespace earshot::explain {

std::unique_ptr<policy::SearchMemory> remembered_at(const policy::ObservationModel& model, const policy::OceanTables& tables,
                                                    std::span<const RecordedDecision> decisions, NorthEast south_west) {
  assert(!decisions.empty());
  auto memory = std::make_unique<policy::SearchMemory>();
  memory->start(model, tables, decisions.front().position - south_west, decisions.front().reception);
  for (const RecordedDecision& decision : decisions.subspan(1))
    memory->remember(model, tables, decision.position - south_west, decision.reception);
  return memory;
}

Contradiction contradiction(const policy::FrozenPolicy& policy, const RecordedDecision& decision, const policy::SearchMemory& memory) {
  if (decision.observation.size() != policy.observation.spec.size() || decision.logits.size() != policy.actions.size() ||
      decision.action >= policy.actions.size())
    return Contradiction::kSizes;
  std::vector<float> again(decision.logits.size());
  policy::find_logits(policy, decision.observation, again);
  if (again != decision.logits) return Contradiction::kLogits;
  again.resize(decision.observation.size());
  policy::observe(memory, policy.observation, again);
  return again == decision.observation ? Contradiction::kNone : Contradiction::kObservation;
}

}  // namespace earshot::explain
