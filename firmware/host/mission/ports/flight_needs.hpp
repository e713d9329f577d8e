#pragma once

#include <filesystem>

#include "firmware/host/mission/mission_file.hpp"

namespace earshot::host {

// What a mission must have for a flight of some kind, beyond what its file must say anyway.

/// @throws host::BadInput when a mission on its own, with no simulator, has no port for a role without which it cannot be flown.
void require_ports_for_sea(const MissionFile& file, const std::filesystem::path& path);

/// For a simulation that brings sound.
/// @throws host::BadInput when the mission has no hydrophone's port, or does not say what is listened for.
void require_hydrophone(const MissionFile& file, const std::filesystem::path& path);

}  // namespace earshot::host
