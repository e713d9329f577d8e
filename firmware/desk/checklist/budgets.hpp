#pragma once

#include "firmware/config/mission.hpp"
#include "firmware/core/units.hpp"

namespace earshot::board {

/// By so much a vehicle that keeps its depth is deeper now and then.
inline constexpr Meters kDepthRoom{2.0};

// What a mission takes when all its steps are taken.

[[nodiscard]] Meters way_of_all_steps(const config::Mission& mission);
/// In still water.
[[nodiscard]] double seconds_for_all_steps(const config::Mission& mission);
/// With the strongest current against it all along.
[[nodiscard]] double seconds_against_current(const config::Mission& mission);
[[nodiscard]] double percent_for_all_steps(const config::Mission& mission);

/// Over ground, from the farthest corner of the search area to the safe point. @pre there is one
[[nodiscard]] Meters longest_way_home(const config::Mission& mission);
/// Against the strongest current all along. @pre there is a safe point
[[nodiscard]] double percent_for_way_home(const config::Mission& mission);

}  // namespace earshot::board
