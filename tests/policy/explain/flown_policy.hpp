#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "firmware/core/units.hpp"
#include "firmware/messages/bearing_measurement.hpp"
#include "firmware/policy/frozen_policy.hpp"
#include "policy/explain/recorded_decision.hpp"

namespace earshot::explain {

/// Ocean tables of one ocean, "falling", 40 dB at the source and 1 dB less every kilometre, for 20 Hz and a vehicle at 300 m.
[[nodiscard]] const policy::OceanTables& falling_ocean();

/// A policy with random weights that sees its belief.
[[nodiscard]] std::unique_ptr<policy::FrozenPolicy> belief_policy(std::uint64_t seed);
/// The same network arithmetic on the paper's simple state.
[[nodiscard]] std::unique_ptr<policy::FrozenPolicy> place_policy(std::uint64_t seed);

/// One without a network, which goes by its belief's own advice: its observation shows every action's preference, ten times as large.
[[nodiscard]] std::unique_ptr<policy::FrozenPolicy> advice_policy();

inline constexpr Decibels kFloor{31.0};

/// What a vehicle writes down that flies the policy, by falling_ocean(), past a source, decision by decision with the arithmetic that
/// flies. The first measurement is too faint to measure, under kFloor. Its area begins at `south_west`; the source stands 12 km north and
/// 15 km east of that, the start 8 km and 6 km. @param bearing  that every measurement bears
[[nodiscard]] std::vector<RecordedDecision> flown(const policy::FrozenPolicy& policy, std::size_t decisions, NorthEast south_west,
                                                  const std::optional<messages::Bearing>& bearing = std::nullopt);

}  // namespace earshot::explain
