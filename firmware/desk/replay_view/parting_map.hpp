#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "firmware/core/geometry.hpp"
#include "firmware/desk/replay_view/counterfactual.hpp"
#include "firmware/desk/replay_view/step_pair.hpp"

namespace earshot::replay_view {

/// The track as it was navigated, where each step sent the vehicle then and where it sends it now, and where they part, as an SVG picture;
/// axes in kilometres.
/// @param from_step  the decisions before it are not drawn, though they may part there
/// @param area   of the mission that is asked about
/// @param title  above it, in UTF-8
[[nodiscard]] std::string parting_map(const Counterfactual& counterfactual, std::span<const StepPair> pairs, std::uint32_t from_step,
                                      const Rectangle& area, const std::string& title);

}  // namespace earshot::replay_view
