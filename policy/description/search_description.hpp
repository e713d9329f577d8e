#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "firmware/core/geometry.hpp"
#include "firmware/core/units.hpp"
#include "firmware/policy/observation.hpp"
#include "sim/search/settings.hpp"

namespace earshot::description {

/// The meaning of a network's inputs and outputs, which its weights do not hold. A policy trained elsewhere carries it along as text.
struct SearchDescription {
  policy::ObservationModel observation;
  std::size_t direction_count = 0;  ///< actions: compass directions, clockwise from north
  Meters step_length;
  NorthEast area_size;                                          ///< of the domain trained in
  Decibels detection_threshold;                                 ///< DT of the reward
  std::vector<std::pair<std::string, std::string>> provenance;  ///< names and values in the order written
};

/// Describes a policy that searches as `settings` say; without provenance.
[[nodiscard]] SearchDescription describe(const search::SearchSettings& settings, const policy::ObservationModel& observation);

/// JSON on one line. It states that the network saw the observation as it is: nothing normalised it on the way.
[[nodiscard]] std::string to_text(const SearchDescription& description);

/// Throws host::BadInput when the text is cut short, something is missing or out of range, or the observation was normalised on its
/// way to the network (or nothing says that it was not).
[[nodiscard]] SearchDescription from_text(std::string_view text);

}  // namespace earshot::description
