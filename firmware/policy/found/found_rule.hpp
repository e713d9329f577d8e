#pragma once

#include <cstdint>
#include <span>

#include "firmware/core/geometry.hpp"
#include "firmware/core/units.hpp"
#include "firmware/policy/belief/belief_model.hpp"
#include "firmware/policy/belief/reception.hpp"
#include "firmware/policy/likelihood/belief_grid.hpp"

namespace earshot::policy {

/// The source is found where it is as likely as this to lie within a step length; README.md says what others would do.
inline constexpr float kFoundProbability = 0.9F;
/// And where it is likelier there than not, at so many measurements since the search or the last declaration began: a vehicle whose steps
/// are whole may come no nearer, and would go to and fro.
inline constexpr float kNearProbability = 0.5F;
inline constexpr std::uint32_t kNearMeasurements = 8;

/// P(|s - x| <= l): that the source s lies within l = step_length of the vehicle x; a cell counts by as much of it as lies within.
/// @param probabilities  of the cells of the model's grid, [north x east]; those outside cells_near() do not count
/// @param position       x, relative to the area's south-west corner
/// Oracle: ProbabilityWithin.*
[[nodiscard]] float probability_within(const BeliefModel& model, std::span<const float> probabilities, NorthEast position);

/// Those cells, with a few that lie beyond.
[[nodiscard]] CellWindow cells_near(const BeliefModel& model, NorthEast position);

/// What the rule judges by: what is believed after a measurement, before anything is ruled out because the search goes on.
struct FoundEvidence {
  float probability;    ///< probability_within() the vehicle's place
  Reception reception;  ///< what it heard there
  Decibels least_snr;   ///< that is expected within a step length of the source
};

/// Says when the source is found: when it is likely to lie within a step length of the vehicle, and is heard as loud as it should be there.
/// Oracle: FoundRule.*
class FoundRule {
 public:
  /// A search begins.
  void start() { *this = {}; }
  /// Whether a source within a step length would be heard like that. Where it would not, it is not found, however likely it is there.
  [[nodiscard]] static bool is_heard_near(const Reception& reception, Decibels least_snr);
  /// To be asked after every measurement at which is_heard_near(). @return where the source is found, FoundDeclaration::near_measurements;
  /// otherwise 0
  [[nodiscard]] std::uint32_t judge(const FoundEvidence& evidence);

 private:
  std::uint32_t near_measurements_ =
      0;  ///< since the last declaration, at which the source was likelier near than not, and heard as it should be
};

}  // namespace earshot::policy
