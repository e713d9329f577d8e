#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "firmware/policy/frozen_policy.hpp"
#include "firmware/policy/observation.hpp"
#include "policy/explain/recorded_decision.hpp"

namespace earshot::explain {

/// The memory (and belief) that the vehicle had when it took the last of these decisions: every decision says where the vehicle stood and
/// what it heard, which is all that its memory was ever given.
/// @param decisions   from step 0 on without a gap, at least one
/// @param south_west  corner of the operating area
[[nodiscard]] std::unique_ptr<policy::SearchMemory> remembered_at(const policy::ObservationModel& model, const policy::OceanTables& tables,
                                                                  std::span<const RecordedDecision> decisions, NorthEast south_west);

/// How a recorded decision contradicts the policy that is said to have taken it.
enum class Contradiction : std::uint8_t {
  kNone,
  kSizes,        ///< another number of observed elements or actions
  kLogits,       ///< the policy answers the recorded observation with other logits
  kObservation,  ///< what was heard and where, replayed, gives another observation
};

/// Compares bit for bit, which is what the vehicle's arithmetic promises.
/// @param memory  remembered_at the decision
[[nodiscard]] Contradiction contradiction(const policy::FrozenPolicy& policy, const RecordedDecision& decision,
                                          const policy::SearchMemory& memory);

}  // namespace earshot::explain
