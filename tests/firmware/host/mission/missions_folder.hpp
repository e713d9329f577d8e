#pragma once

#include <filesystem>

namespace earshot::host {

/// The missions that ship.
inline const std::filesystem::path kMissions = std::filesystem::path(EARSHOT_SOURCE_DIR) / "firmware/boards/linux/missions";

}  // namespace earshot::host
