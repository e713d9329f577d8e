#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "firmware/core/geometry.hpp"
#include "firmware/core/units.hpp"
#include "firmware/messages/found_declaration.hpp"
#include "firmware/policy/belief_model.hpp"
#include "firmware/policy/reception.hpp"

namespace earshot::policy {

/// The source is found where it is as likely as this to lie within a step length; README.md says what others would do.
inline constexpr float kFoundProbability = 0.9F;

/// P(|s - x| <= l): that the source s lies within l = step_length of the vehicle x; a cell counts by as much of it as lies within.
/// @param probabilities  of the cells of the model's grid, [north x east]
/// @param position       x, relative to the area's south-west corner
/// Oracle: ProbabilityWithin.*
[[nodiscard]] float probability_within(const BeliefModel& model, std::span<const float> probabilities, NorthEast position);

/// What the rule judges by: all that is believed after a look, before anything is ruled out because the search goes on.
struct FoundEvidence {
  std::span<const float> probabilities;  ///< [north x east]
  NorthEast position;                    ///< of the vehicle, relative to the area's south-west corner
  Reception reception;                   ///< what it heard there
  Decibels least_snr;                    ///< that is expected within a step length of the source
  std::uint32_t look;                    ///< which look it was, the one at the start being 0
};

/// The source is found when it is likely to lie within a step length of the vehicle, and is heard as loud as it should be there.
/// @return nothing where it is not
/// Oracle: FoundRule.*
[[nodiscard]] std::optional<messages::FoundDeclaration> judge_found(const BeliefModel& model, const FoundEvidence& evidence);

}  // namespace earshot::policy
