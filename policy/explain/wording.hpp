#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "firmware/core/geometry.hpp"
#include "firmware/policy/observation.hpp"

namespace earshot::explain {

/// The subject of an element of an observation, in the order of a report.
enum class Subject : std::uint8_t {
  kPlace,     ///< where the vehicle is
  kMoved,     ///< how it moved
  kHeard,     ///< what it heard
  kBelieved,  ///< where the source is believed to be
  kPromised,  ///< what each direction promises
};

[[nodiscard]] Subject subject_of(policy::Feature feature);
[[nodiscard]] std::string_view to_string(Subject subject);

/// Whether a policy observes anything that was measured, or a belief made of it. Otherwise it goes by the vehicle's place and steps alone.
[[nodiscard]] bool uses_measurements(const policy::ObservationSpec& spec);

/// A bearing in whole degrees, "000°" to "359°".
/// @param bearing  clockwise from north
[[nodiscard]] std::string degrees_to_string(Radians bearing);

/// The nearest of the sixteen points of the compass, "NNE".
/// @param bearing  clockwise from north
[[nodiscard]] std::string compass_point(Radians bearing);

/// "N", "NE", "NNE" where a direction is one of the sixteen points of the compass; otherwise degrees, "014°".
[[nodiscard]] std::string direction_name(const UnitNorthEast& direction);

/// "chance of finding the source by going NE"
[[nodiscard]] std::string name_of(const policy::ObservationElement& element,
                                  const FixedVector<UnitNorthEast, config::kMaxActions>& actions);

/// The raw value of an element of an observation with its unit, "3.20 km" or "12.0 %".
[[nodiscard]] std::string value_of(const policy::ObservationElement& element, float value);

/// printf's "%.*f", without a minus sign in front of zero
[[nodiscard]] std::string fixed(double x, int digits);

/// "× 1.83", "× 20 000", "× 0.0021", "× 3.2·10⁻⁷": what a part of the log-probability does to the probability
[[nodiscard]] std::string factor_to_string(double part);

}  // namespace earshot::explain
