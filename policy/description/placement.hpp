#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "sim/search/settings.hpp"

namespace earshot::description {

/// What people call where the source is put, in the order of search::SourcePlacement.
inline constexpr std::array<std::string_view, 2> kPlacements{"fixed", "changing"};
[[nodiscard]] std::string_view name_of(search::SourcePlacement placement);
/// Nothing for a name that is none of kPlacements.
[[nodiscard]] std::optional<search::SourcePlacement> placement_named(std::string_view name);

/// The source that a policy was trained with, as the line "source = ..." of its provenance says; nothing when no line does.
/// @param provenance  lines "name = value"
/// Oracle: Placement.* in tests/policy/description
[[nodiscard]] std::optional<search::SourcePlacement> placement_in(std::string_view provenance);

}  // namespace earshot::description
