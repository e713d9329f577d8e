#pragma once

#include <string>

#include "firmware/core/geometry.hpp"

namespace earshot::command_line {

/// Reads "NORTH_M,EAST_M": metres, or each with its unit ("10km,9500m"). Throws host::BadInput naming the option when it is anything
/// else, and when both numbers are below 100 without a unit: whoever writes 10,10 means kilometres more often than a place beside the
/// origin. 0,0 is the same in both.
[[nodiscard]] NorthEast north_east_of(const std::string& option, const std::string& text);

}  // namespace earshot::command_line
