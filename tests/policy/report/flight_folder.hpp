#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

#include "firmware/policy/frozen_policy.hpp"
#include "policy/explain/recorded_decision.hpp"

namespace earshot::report {

/// Writes the decisions as earshotd journals them.
void write_journal(const std::filesystem::path& path, const std::vector<explain::RecordedDecision>& decisions);

/// What a simulated flight leaves: journal, policy, for one with a belief its tables (explain::falling_ocean()), summary.json, track.csv,
/// snr.csv. The area begins at `south_west`.
void write_flight(const std::filesystem::path& folder, const policy::FrozenPolicy& policy,
                  const std::vector<explain::RecordedDecision>& decisions, NorthEast south_west);

}  // namespace earshot::report
