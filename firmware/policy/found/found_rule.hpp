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
/// And where it is likelier there than not, at so many looks since the search or the last declaration began: a vehicle whose steps are
/// whole may come no nearer, and would go to and fro.
inline constexpr float kNearProbability = 0.5F;
inline constexpr std::uint32_t kNearLooks = 8;

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
};

/// Says when the source is found: when it is likely to lie within a step length of the vehicle, and is heard as loud as it should be there.
/// Oracle: FoundRule.*
class FoundRule {
 public:
  /// A search begins.
  void start() { *this = {}; }
  /// To be asked after every look. @return nothing where the source is not found
  [[nodiscard]] std::optional<messages::FoundDeclaration> judge(const BeliefModel& model, const FoundEvidence& evidence);

 private:
  std::uint32_t looks_ = 0;       ///< of this search
  std::uint32_t near_looks_ = 0;  ///< since the last declaration, at which the source was likelier near than not, and heard as it should be
};

}  // namespace earshot::policy
