#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "firmware/policy/action_draw.hpp"

namespace earshot::description {

/// Names of the ways to draw an action, in the order of policy::ActionDraw.
inline constexpr std::array<std::string_view, 2> kDraws{"argmax", "sampled"};
[[nodiscard]] std::string_view name_of(policy::ActionDraw draw);
/// Nothing for a name that is none of kDraws.
[[nodiscard]] std::optional<policy::ActionDraw> draw_named(std::string_view name);

}  // namespace earshot::description
