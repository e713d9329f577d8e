#pragma once

#include <filesystem>
#include <optional>

#include "firmware/wire/n2k/local_plane.hpp"

namespace earshot::journal {

/// The mission's plane where a simulated flight left it beside its journal, in summary.json. Nothing where there is none, and of any other
/// journal in that folder.
[[nodiscard]] std::optional<n2k::LocalPlane> plane_beside(const std::filesystem::path& journal);

}  // namespace earshot::journal
