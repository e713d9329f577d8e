#pragma once

#include <optional>

#include "firmware/config/mission.hpp"
#include "firmware/config/safety.hpp"
#include "firmware/core/time.hpp"
#include "firmware/core/units.hpp"
#include "firmware/safety/situation.hpp"

namespace earshot::safety {

/// The number that a rule about `condition` compares with its limit, in the condition's unit; 0 or 1 of one that is only true or false.
/// Nothing while it is not known; rules about the age of what should tell it then act.
/// @pre the situation has a fix
[[nodiscard]] std::optional<double> measure(config::Condition condition, const config::Mission& mission, const Situation& situation);

/// Through the water, at search speed, for a way over ground with the strongest current against it all along:  way v / (v - c).
/// @param mission  one that check() accepts, so that the current is slower than the search
[[nodiscard]] Meters against_current(const config::Mission& mission, Meters way);

/// Depth and altitude are those that the vehicle will have so much later if it goes on down as it does. A rule about them that waits at
/// least as long never acts on a vehicle that levels out before its limit.
inline constexpr Duration kForesight = Duration::seconds(5);
/// A vehicle that sinks no faster keeps its depth as well as it can: nothing is foreseen of it.
inline constexpr MetersPerSecond kKeepsDepth{0.2};

}  // namespace earshot::safety
