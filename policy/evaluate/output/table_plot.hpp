#pragma once

#include <span>
#include <string>

#include "policy/evaluate/output/table.hpp"

namespace earshot::evaluate {

/// gnuplot's commands: share found, restricted mean time to find and mean reward with their intervals, side by side for every policy, world
/// by world. A mean reward far below all others stands as an arrowhead with its number at the end of an axis that is the others'.
[[nodiscard]] std::string as_plot(std::span<const Row> rows, const std::string& title);

}  // namespace earshot::evaluate
