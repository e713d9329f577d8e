#pragma once

#include <array>
#include <cstdint>

#include "firmware/config/capacities.hpp"
#include "firmware/core/geometry.hpp"
#include "firmware/core/units.hpp"
#include "firmware/messages/belief_summary.hpp"
#include "firmware/policy/belief/reception.hpp"
#include "firmware/policy/observation.hpp"
#include "firmware/policy/tables/ocean_tables.hpp"

namespace earshot::policy {

struct FrozenPolicy;

/// What is heard in a golden search: no bearing, for a `.policy` file holds none. Kept small, for there are many in the vehicle's memory.
struct GoldenReception {
  Decibels snr;
  bool too_faint = false;
  friend constexpr bool operator==(GoldenReception, GoldenReception) = default;
  [[nodiscard]] Reception heard() const { return {.snr = snr, .too_faint = too_faint}; }
};

/// One step of a search that was flown when the policy was frozen: what went in, and what the decision was made of, bit for bit.
struct GoldenStep {
  NorthEast place;  ///< of the vehicle, relative to the area's south-west corner, in the area
  GoldenReception reception;
  messages::BeliefSummary belief;  ///< zero, as is its fingerprint, when no element of the observation sees a belief
  std::uint32_t fingerprint = 0;   ///< OceanBelief::fingerprint
  std::array<float, config::kMaxObservation> observation{};
  std::array<float, config::kMaxActions> logits{};
};

/// A search from its start.
using GoldenTrajectory = std::array<GoldenStep, config::kGoldenSteps>;
using GoldenTrajectories = std::array<GoldenTrajectory, config::kGoldenTrajectories>;

/// The oceans of golden searches, made up and the same for every policy, for a policy flies with any: straight lines of two slopes, and one
/// with a zone in which it gets loud again. Their ranges reach across the area.
void make_golden_tables(NorthEast area_size, OceanTables& tables);

/// Flies the golden trajectories of `policy` along their places and writes down what this build computes from the receptions there.
/// @param policy  one that check() finds nothing wrong with
/// @param memory, tables  to work in; what they held is gone
void record_golden(FrozenPolicy& policy, SearchMemory& memory, OceanTables& tables);

/// Whether this build, flying the golden trajectories again, gives the beliefs, observations and logits that are written there, bit for
/// bit, and every logit is finite. A build that fuses multiply-adds, or with another tanh, does not.
/// @param memory, tables  to work in; what they held is gone
/// Oracle: Golden.*, ContractedBuild.*, LibmTanhBuild.*
[[nodiscard]] bool repeats_golden(const FrozenPolicy& policy, SearchMemory& memory, OceanTables& tables);

}  // namespace earshot::policy
