#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "firmware/config/capacities.hpp"
#include "firmware/core/fixed_vector.hpp"
#include "firmware/core/geometry.hpp"
#include "firmware/core/status.hpp"
#include "firmware/core/units.hpp"

namespace earshot::policy {

// The seam that training and flight share: sim/search and firmware/runtime build observations with this very code.

/// What one element of an observation is taken from.
enum class Feature : std::uint8_t {
  kEast = 1,       ///< x of the vehicle in the operating area, metres east of its south-west corner
  kNorth = 2,      ///< y of the vehicle in the operating area, metres north of its south-west corner
  kStepEast = 3,   ///< displacement over one remembered step, metres east
  kStepNorth = 4,  ///< displacement over one remembered step, metres north
  kStepSnr = 5,    ///< SNR heard at the end of that step, dB
};

/// One element of an observation: element = (raw - offset) * scale.
struct ObservationElement {
  Feature feature = Feature::kEast;
  std::uint8_t age = 0;  ///< remembered step it is taken from, 0 the latest; 0 for a position
  float offset = 0.0F;   ///< in the raw value's unit
  float scale = 1.0F;    ///< one over the raw value's unit
  friend constexpr bool operator==(const ObservationElement&, const ObservationElement&) = default;
};

using ObservationSpec = FixedVector<ObservationElement, config::kMaxObservation>;

/// What the vehicle remembers of its search: where it is and what it heard at the end of each of the last steps.
/// A step not yet taken counts as no displacement and an SNR of zero; the start fills the newest slot with the SNR heard there.
class SearchMemory {
 public:
  /// Forgets everything; the vehicle stands at `position` (relative to the area's south-west corner) and hears `snr`.
  void start(NorthEast position, Decibels snr);
  /// One step is over: the vehicle now stands at `position` and hears `snr`.
  void remember(NorthEast position, Decibels snr);

  /// Raw value of one element, metres or dB.
  [[nodiscard]] double raw(const ObservationElement& element) const;

 private:
  struct Step {
    NorthEast displacement;
    Decibels snr;
  };
  NorthEast position_;
  std::array<Step, config::kMaxRememberedSteps> steps_{};  ///< newest first
};

/// Writes spec.size() elements to `observation` (its size is spec.size()).
void observe(const SearchMemory& memory, const ObservationSpec& spec, std::span<float> observation);

/// The paper's simple state o = (x, y), scaled to [-1, 1] over an area of the given size (north and east).
[[nodiscard]] ObservationSpec simple_state(NorthEast area_size);

/// The paper's memory state: (dx, dy, SNR) of each of the last `steps` steps, newest first; displacements in step lengths, SNR in units of
/// 30 dB about the detection threshold. kOutOfRange unless 1 <= steps <= kMaxRememberedSteps.
[[nodiscard]] Result<ObservationSpec> memory_state(std::size_t steps, Meters step_length, Decibels detection_threshold);

}  // namespace earshot::policy
