#pragma once

#include <string>
#include <vector>

#include "firmware/policy/observation.hpp"

namespace earshot::description {

/// A name for each element of an observation, no two alike: that of its feature (firmware/policy/README.md has their table), behind it the
/// step that is remembered, 0 the latest, or the action: "east", "step_snr_0", "preference_7". Of a feature that nobody knows "unknown".
[[nodiscard]] std::vector<std::string> element_names(const policy::ObservationSpec& spec);

}  // namespace earshot::description
