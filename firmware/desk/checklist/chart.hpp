#pragma once

#include <string>

#include "firmware/config/mission.hpp"

namespace earshot::board {

/// A chart of where a mission may go, as an SVG picture: search box, way-points, the fence's three tiers, zones where the vehicle may not
/// surface, safe point; north is up, axes in kilometres.
/// @param title  above the chart, in UTF-8
[[nodiscard]] std::string chart(const config::Mission& mission, const std::string& title);

}  // namespace earshot::board
