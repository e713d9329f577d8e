#pragma once

#include <cstdint>
#include <vector>

#include "firmware/core/geometry.hpp"
#include "firmware/messages/snr_measurement.hpp"
#include "firmware/policy/observation.hpp"

namespace earshot::explain {

/// The vehicle that an observation is compared with: it has heard nothing yet.
enum class Baseline : std::uint8_t {
  kCentre,  ///< in the middle of the area
  kHere,    ///< where the vehicle is: then only what it heard and how it moved can have moved the choice
};

/// A measurement that says nothing: the signal lies somewhere below a level that no signal reaches.
inline constexpr policy::Reception kNothingLearnt{.snr = messages::kMostSnr, .too_faint = true};

/// The observation of a vehicle that has neither moved nor heard anything: no remembered displacement, every remembered SNR at the
/// detection threshold (a newest measurement that is neither a detection nor a miss), and a belief that knows only that the source is not
/// within a step, with its mean for a likeliest place.
/// @param place  relative to the area's south-west corner
[[nodiscard]] std::vector<float> uninformed_observation(const policy::ObservationModel& model, const policy::OceanTables& tables,
                                                        NorthEast place, Decibels detection_threshold);

}  // namespace earshot::explain
