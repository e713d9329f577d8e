#pragma once

#include <string>

#include "firmware/core/geometry.hpp"

namespace earshot::report {

/// A place as gnuplot reads it: kilometres east, kilometres north.
[[nodiscard]] std::string km(NorthEast place);

/// gnuplot's commands for axes over an area, in kilometres.
[[nodiscard]] std::string km_ranges(const Rectangle& area);

}  // namespace earshot::report
