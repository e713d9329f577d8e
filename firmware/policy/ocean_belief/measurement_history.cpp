#include "firmware/policy/ocean_belief/measurement_history.hpp"

#include <algorithm>

namespace earshot::policy {

PastBearing::PastBearing(const std::optional<messages::Bearing>& bearing) {
  if (!bearing) return;
  direction_ = static_cast<float>(bearing->direction.value);
  deviation_ = static_cast<float>(bearing->deviation.value);
  mirror_axis_ = static_cast<float>(bearing->mirror_axis.value_or(bearing->direction).value);
}

messages::Bearing PastBearing::bearing() const {
  return {.direction = Radians{double{direction_}}, .deviation = Radians{double{deviation_}}, .mirror_axis = Radians{double{mirror_axis_}}};
}

Measurement measurement_of(NorthEast position, const Reception& reception) {
  return {.position = position, .snr = reception.snr, .bearing = PastBearing(reception.bearing), .too_faint = reception.too_faint};
}

std::uint32_t MeasurementHistory::add(const Measurement& measurement) {
  static_cast<void>(measurements_.push_back(measurement));  // a full one counts on
  return count_++;
}

void MeasurementHistory::mark_declared() {
  if (is_whole() && count_ > 0) measurements_[count_ - 1].was_declared = true;
}

std::size_t MeasurementHistory::visits(NorthEast place, Meters within) const {
  return static_cast<std::size_t>(std::count_if(measurements_.begin(), measurements_.end(), [&](const Measurement& measurement) {
    return range_between(measurement.position, place) < within;
  }));
}

}  // namespace earshot::policy
