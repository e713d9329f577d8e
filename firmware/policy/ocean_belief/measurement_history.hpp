#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "firmware/config/capacities.hpp"
#include "firmware/core/fixed_vector.hpp"
#include "firmware/core/geometry.hpp"
#include "firmware/core/units.hpp"
#include "firmware/messages/bearing_measurement.hpp"
#include "firmware/policy/belief/reception.hpp"

namespace earshot::policy {

/// A bearing in little memory, or none.
class PastBearing {
 public:
  PastBearing() = default;
  explicit PastBearing(const std::optional<messages::Bearing>& bearing);
  [[nodiscard]] bool is_there() const { return deviation_ > 0.0F; }
  /// A bearing that is there. Where nothing was mirrored, the mirror axis is the direction itself.
  [[nodiscard]] messages::Bearing bearing() const;

 private:
  float direction_ = 0.0F;  ///< rad, all three
  float deviation_ = 0.0F;  ///< 0: there is none
  float mirror_axis_ = 0.0F;
};

/// What a vehicle measured at a place, as the hypotheses to come are weighed by it.
struct Measurement {
  NorthEast position;  ///< relative to the area's south-west corner
  Decibels snr;
  PastBearing bearing;
  bool too_faint = false;     ///< the signal lies somewhere below `snr`
  bool was_declared = false;  ///< the source was declared found there, and was not
};

/// As it is remembered.
[[nodiscard]] Measurement measurement_of(NorthEast position, const Reception& reception);

/// The memory of all that was measured since the start. It owns the measurements, the oldest first, and their count.
class MeasurementHistory {
 public:
  /// Forgets all.
  void start() {
    measurements_.clear();
    count_ = 0;
  }
  /// A measurement that no longer fits is counted and not kept. @return its index
  std::uint32_t add(const Measurement& measurement);
  /// The source was declared found at the last measurement, and was not.
  void mark_declared();

  /// Measurements since the start, those that did not fit among them.
  [[nodiscard]] std::uint32_t count() const { return count_; }
  /// Whether every measurement is in it. Else no hypothesis can be weighed by all of them.
  [[nodiscard]] bool is_whole() const { return count_ == measurements_.size(); }
  /// Those that fitted.
  [[nodiscard]] std::span<const Measurement> measurements() const { return measurements_.span(); }
  /// How many of these were taken within a range of a place.
  [[nodiscard]] std::size_t visits(NorthEast place, Meters within) const;

 private:
  FixedVector<Measurement, config::kMaxBeliefMeasurements> measurements_;
  std::uint32_t count_ = 0;
};

}  // namespace earshot::policy
