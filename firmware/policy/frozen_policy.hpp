#pragma once

#include <cstdint>
#include <span>

#include "firmware/config/capacities.hpp"
#include "firmware/config/mission.hpp"
#include "firmware/core/fixed_vector.hpp"
#include "firmware/core/geometry.hpp"
#include "firmware/core/units.hpp"
#include "firmware/policy/action_draw.hpp"
#include "firmware/policy/envelope/provenance.hpp"
#include "firmware/policy/golden.hpp"
#include "firmware/policy/network.hpp"
#include "firmware/policy/observation.hpp"
#include "firmware/policy/tables/ocean_tables.hpp"

namespace earshot::policy {

/// Everything a `.policy` file holds but its checksum and signature. It flies with any ocean tables that cover the mission.
struct FrozenPolicy {
  ObservationModel observation;  ///< the belief's actions, step_length, area_size, detection_threshold are those below
  FixedVector<UnitNorthEast, config::kMaxActions> actions;  ///< direction of each action; the table saves the vehicle sine and cosine
  Meters step_length;                                       ///< l the policy was trained with
  NorthEast area_size;                                      ///< of the area it was trained in, both > 0
  Decibels detection_threshold;                             ///< DT it was trained with
  ActionDraw draw = ActionDraw::kArgmax;
  Network network;  ///< without hidden layers: none, see find_logits()
  GoldenTrajectories golden{};
  Provenance provenance;  ///< training command, commit, environment hash
};

/// Logits of every action for one observation: those of the network. A policy without a network goes by the belief's own advice: the logit
/// of an action is the element of the observation that shows its preference (Feature::kPreference), the greatest that of least regret.
/// @param policy       one that check() finds nothing wrong with
/// @param observation  [observation_size]
/// @param logits       [actions]
void find_logits(const FrozenPolicy& policy, std::span<const float> observation, std::span<float> logits);

/// Which of a mission's numbers is not the one that a policy was trained, or frozen, with.
enum class Mismatch : std::uint8_t { kNone, kStepLength, kAreaSize, kDetectionThreshold, kListening };

/// Corners far from the origin are rounded, and their difference with them; a vehicle does not notice.
inline constexpr Meters kAreaSizeTolerance{0.001};

/// The first of the mission's numbers that `policy` was not trained with; its window: frozen with. Where the area lies does not matter,
/// only its size.
[[nodiscard]] Mismatch mismatch(const FrozenPolicy& policy, const config::Mission& mission);

/// What a mission listens for, from anywhere in its area.
[[nodiscard]] SearchedSound searched_sound(const config::Mission& mission);

}  // namespace earshot::policy
