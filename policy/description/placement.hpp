#pragma once

#include <optional>
#include <string_view>

#include "sim/search/settings.hpp"

namespace earshot::description {

/// The source that a policy was trained with, as the line "source = ..." of its provenance says; nothing when no line does.
/// @param provenance  lines "name = value"
/// Oracle: Placement.* in tests/policy/description
[[nodiscard]] std::optional<search::SourcePlacement> placement_in(std::string_view provenance);

}  // namespace earshot::description
