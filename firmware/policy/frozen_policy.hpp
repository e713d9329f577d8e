#pragma once

#include <cstdint>

#include "firmware/config/capacities.hpp"
#include "firmware/config/mission.hpp"
#include "firmware/core/fixed_vector.hpp"
#include "firmware/core/geometry.hpp"
#include "firmware/core/units.hpp"
#include "firmware/policy/action_draw.hpp"
#include "firmware/policy/format/provenance.hpp"
#include "firmware/policy/golden.hpp"
#include "firmware/policy/network.hpp"
#include "firmware/policy/observation.hpp"

namespace earshot::policy {

/// Everything a `.policy` file holds but its checksum and signature.
struct FrozenPolicy {
  ObservationModel observation;  ///< the belief's actions, step_length, area_size, detection_threshold are those below
  FixedVector<UnitNorthEast, config::kMaxActions> actions;  ///< direction of each action; the table saves the vehicle sine and cosine
  Meters step_length;                                       ///< l the policy was trained with
  NorthEast area_size;                                      ///< of the area it was trained in, both > 0
  Decibels detection_threshold;                             ///< DT it was trained with
  ActionDraw draw = ActionDraw::kArgmax;
  Network network;
  GoldenTrajectories golden{};
  Provenance provenance;  ///< training command, commit, environment hash
};

/// Which of a mission's numbers is not the one that a policy was trained, or frozen, with.
enum class Mismatch : std::uint8_t { kNone, kStepLength, kAreaSize, kDetectionThreshold, kListening };

/// Corners far from the origin are rounded, and their difference with them; a vehicle does not notice.
inline constexpr Meters kAreaSizeTolerance{0.001};

/// The first of the mission's numbers that `policy` was not trained with; its window: frozen with. Where the area lies does not matter,
/// only its size.
[[nodiscard]] Mismatch mismatch(const FrozenPolicy& policy, const config::Mission& mission);

}  // namespace earshot::policy
