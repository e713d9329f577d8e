#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "firmware/config/capacities.hpp"
#include "firmware/config/listening_window.hpp"
#include "firmware/core/fixed_vector.hpp"
#include "firmware/core/geometry.hpp"
#include "firmware/core/status.hpp"
#include "firmware/core/units.hpp"
#include "firmware/policy/belief/reception.hpp"
#include "firmware/policy/ocean_belief/ocean_belief.hpp"
#include "firmware/policy/tables/ocean_tables.hpp"

namespace earshot::policy {

// The seam that training and flight share: sim/search and firmware/runtime build observations with this very code.

/// The quantity that an element of an observation shows. The numbers stand in policies: none may change, and their ranges say what a
/// feature needs (32 and above: the belief, one element for each action).
///
/// A new one also needs its value (raw(), is_known() and needs_belief() in observation.cpp), the bound that a policy is judged by
/// (most_raw() in check/policy_check.cpp), its words (policy/explain/wording.cpp) and what it is explained against
/// (policy/explain/baseline.cpp).
enum class Feature : std::uint8_t {
  kEast = 1,       ///< x of the vehicle in the operating area, metres east of its south-west corner
  kNorth = 2,      ///< y of the vehicle in the operating area, metres north of its south-west corner
  kStepEast = 3,   ///< displacement over one remembered step, metres east
  kStepNorth = 4,  ///< displacement over one remembered step, metres north
  kStepSnr = 5,    ///< SNR heard at the end of that step, dB; where it was too faint to measure, the least that could have been measured

  kToSouthEdge = 6,  ///< distance to the operating area's edge, metres; negative beyond it
  kToNorthEdge = 7,
  kToWestEdge = 8,
  kToEastEdge = 9,

  // Of the belief, relative to the vehicle.
  kLikeliestEast = 16,   ///< likeliest place of the source, metres east of the vehicle
  kLikeliestNorth = 17,  ///< likewise, metres north
  kMeanEast = 18,        ///< mean place of the source, metres east of the vehicle
  kMeanNorth = 19,       ///< likewise, metres north
  kSpread = 20,          ///< root mean square distance of the source from the mean place, metres
  kLikeliestShare = 21,  ///< probability of the likeliest cell
  kEffectiveCells = 22,  ///< number of cells the belief is spread over

  // Of the belief, one for each action; `age` is the action's index.
  kFound = 32,            ///< probability that the action's end lies within a step length of the source
  kFindProbability = 33,  ///< the same for the best place within a few steps, the border's cost taken off (ActionValues::find_probability)
  kDetected = 34,         ///< probability of a detection at the action's end
  kBorder = 35,           ///< how deep the action's end lies in the border: 0 inside, 1 at the edge, more beyond
  kRegret = 36,           ///< expected cost of the search after the action, less that after the best
  kPreference = 37,       ///< 1 / (1 + regret): 1 for the best action, and telling small regrets apart
  kApproach = 38,         ///< by how much the action brings the vehicle nearer to the likeliest place of the source, metres
};

/// One element of an observation: element = (raw - offset) * scale.
struct ObservationElement {
  Feature feature = Feature::kEast;
  std::uint8_t age = 0;  ///< remembered step it is taken from, 0 the latest; index of the action; 0 for all else
  float offset = 0.0F;   ///< in the raw value's unit
  float scale = 1.0F;    ///< one over the raw value's unit
  friend constexpr bool operator==(const ObservationElement&, const ObservationElement&) = default;
};

using ObservationSpec = FixedVector<ObservationElement, config::kMaxObservation>;

/// The element that a raw value makes.
[[nodiscard]] float scaled(const ObservationElement& element, double raw);

/// Whether a feature is taken from the belief.
[[nodiscard]] bool needs_belief(Feature feature);
/// Whether any element of the observation is.
[[nodiscard]] bool needs_belief(const ObservationSpec& spec);
/// Whether any element of the observation needs to know how large the area is.
[[nodiscard]] bool needs_area(const ObservationSpec& spec);
/// Whether this build knows the feature.
[[nodiscard]] bool is_known(Feature feature);

/// The elements that a policy sees, and the model of the search that its belief takes for granted.
struct ObservationModel {
  ObservationSpec spec;
  config::ListeningWindow listening = {};  ///< over which a `Reception` is taken
  BeliefModel belief = {};                 ///< unused, and no time spent on it, when no element of `spec` needs it
};

/// The vehicle's memory of its search: where it was and what it heard at the end of each of the last steps.
/// A step not yet taken counts as no displacement and an SNR of zero; the start fills the newest slot with the SNR heard there.
/// Every call is given the model, and the ocean tables, of the one before. Of tables nothing is used where the model's spec sees no belief:
/// they may be empty then.
class SearchMemory {
 public:
  /// Forgets everything; the vehicle stands at `position` (relative to the area's south-west corner); `reception` is what it hears there.
  void start(const ObservationModel& model, const OceanTables& tables, NorthEast position, Reception reception);
  /// One step is over: the vehicle now stands at `position`; `reception` is what it hears there.
  void remember(const ObservationModel& model, const OceanTables& tables, NorthEast position, Reception reception);

  /// Refines the hypotheses further by what was heard (OceanBelief::refine), where the model's spec sees a belief. @return whether anything
  /// is left
  bool refine(const ObservationModel& model, const OceanTables& tables);

  /// Raw value of one element.
  [[nodiscard]] double raw(const ObservationModel& model, const ObservationElement& element) const;
  /// What is believed about the source; meaningful only when the model's spec needs it.
  [[nodiscard]] const OceanBelief& belief() const { return belief_; }

 private:
  struct Step {
    NorthEast displacement;
    Decibels snr;
  };

  [[nodiscard]] double of_belief(const BeliefModel& model, const ObservationElement& element) const;

  NorthEast position_;
  std::array<Step, config::kMaxRememberedSteps> steps_{};  ///< newest first
  OceanBelief belief_;
};

/// Writes the model's elements to `observation` (its size is model.spec.size()).
void observe(const SearchMemory& memory, const ObservationModel& model, std::span<float> observation);

/// The paper's simple state o = (x, y), scaled to [-1, 1] over an area of the given size (north and east).
[[nodiscard]] ObservationSpec simple_state(NorthEast area_size);

/// The paper's memory state: (dx, dy, SNR) of each of the last `steps` steps, newest first; displacements in step lengths, SNR in units of
/// 30 dB about the detection threshold. kOutOfRange unless 1 <= steps <= kMaxRememberedSteps.
[[nodiscard]] Result<ObservationSpec> memory_state(std::size_t steps, Meters step_length, Decibels detection_threshold);

/// Distances to the edges, the belief, and the values of each of the model's actions.
/// @param model  its belief filled in
[[nodiscard]] ObservationSpec belief_state(const BeliefModel& model);

}  // namespace earshot::policy
