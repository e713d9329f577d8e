#pragma once

#include <cstddef>
#include <vector>

#include "policy/tables/merge.hpp"
#include "policy/tables/ocean_curve.hpp"

namespace earshot::tables {

/// The curves that are expected, first and as they are, and as many of the others, merged, as there is room for beside them. All expected
/// ones together weigh as much as all others together, and among themselves as given.
/// @param expected  may be none: the others alone, merged; @param others  may be none: the expected ones alone
/// @param at_most   >= 1
/// Throws host::BadInput where those expected leave no room: for one of the others, if there are any.
/// Oracle: Expected.*
[[nodiscard]] Merged merge_beside(const std::vector<OceanCurve>& expected, const std::vector<OceanCurve>& others, std::size_t at_most);

}  // namespace earshot::tables
