#pragma once

#include <cstddef>
#include <vector>

#include "policy/tables/merge.hpp"
#include "policy/tables/ocean_curve.hpp"

namespace earshot::tables {

/// Those of which none is merged with another.
struct Unmerged {
  std::vector<OceanCurve> expected = {};
  std::vector<OceanCurve> variants = {};  ///< of what is expected
};

/// The curves that are expected and their variants, first and as they are, and as many of the others, merged, as there is room for beside
/// them. A variant weighs, on the mean, as much as one of the merged others, and all expected ones as much as variants and others together;
/// among themselves they weigh as given.
/// @param unmerged  may be none; @param others  may be none
/// @param at_most   >= 1
/// Throws host::BadInput where those unmerged leave no room: for one of the others, if there are any.
/// Oracle: Expected.*
[[nodiscard]] Merged merge_beside(const Unmerged& unmerged, const std::vector<OceanCurve>& others, std::size_t at_most);

}  // namespace earshot::tables
