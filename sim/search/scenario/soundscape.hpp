#pragma once

#include <cstddef>
#include <vector>

#include "firmware/core/geometry.hpp"
#include "firmware/core/units.hpp"
#include "sim/search/scenario/scenario.hpp"
#include "sim/sonar/fan.hpp"
#include "sim/sonar/snr_curve.hpp"

namespace earshot::search {

/// SNR of a source at the vehicle's depth around one position, which may differ from bearing to bearing.
struct SnrFan {
  sonar::Fan fan;  ///< of one depth
  Decibels source_level;
  Decibels noise_level;
};

/// What can be heard in the oceans that a search may be in. Looked up in constant time without allocating.
class Soundscape {
 public:
  /// Oceans that are the same on every bearing; a search is in one of them. @param curves  at least one
  explicit Soundscape(std::vector<sonar::SnrCurve> curves);
  /// One ocean that differs with place; around a source it is as around the nearest of the fans' centres.
  /// @param expected  what a vehicle that does not know the fans goes by
  /// @param fans      at least one; each holds one value a bearing and range
  Soundscape(sonar::SnrCurve expected, std::vector<SnrFan> fans);

  [[nodiscard]] bool is_one_curve() const { return fans_.empty() && curves_.size() == 1; }
  /// Oceans to draw from.
  [[nodiscard]] std::size_t ocean_count() const { return fans_.empty() ? curves_.size() : 1; }
  /// The number of the field that belongs to a source in one of the oceans.
  [[nodiscard]] std::size_t field_of(std::size_t ocean, NorthEast source) const;
  /// @param field  field_of() the source
  /// Oracle: Soundscape.*
  [[nodiscard]] Decibels snr(std::size_t field, NorthEast source, NorthEast receiver) const;

  /// What the environment itself says of SNR against range: the first of the curves.
  [[nodiscard]] const sonar::SnrCurve& expected() const { return curves_.front(); }

 private:
  std::vector<sonar::SnrCurve> curves_;
  std::vector<SnrFan> fans_;
};

/// The fans of a scenario's field library, of the vehicle's depth alone; throws as soundscape_of does.
[[nodiscard]] std::vector<SnrFan> fans_of(const Scenario& scenario, Meters vehicle_depth, Meters furthest);

/// The soundscape of a scenario: its environment and its other oceans, or its field library.
///
/// @param furthest  range that can be looked up
/// Throws as compute_snr_curve does, also for the other oceans; host::BadInput when the library does not reach as far, has no field
/// at that depth, or is of a source at another depth or frequency than the environment's.
[[nodiscard]] Soundscape soundscape_of(const Scenario& scenario, Meters vehicle_depth, Meters furthest);

}  // namespace earshot::search
