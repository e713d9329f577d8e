#pragma once

#include "firmware/policy/belief/belief_model.hpp"
#include "sim/search/settings.hpp"

namespace earshot::search {

/// What a vehicle that knows the search takes for granted, its grid as fine as fits (500 m at best), its costs chosen for finding.
[[nodiscard]] policy::BeliefModel belief_model(const SearchSettings& settings);

}  // namespace earshot::search
