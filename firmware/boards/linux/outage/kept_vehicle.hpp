#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "firmware/core/time.hpp"
#include "firmware/host/mission/mission_file.hpp"

namespace earshot::board {

/// What is kept beside a vehicle's safety record so that it can be brought up though its mission file is gone: mission, period and ports,
/// but for hydrophones, and no key. Its bytes are this build's alone.
/// @return empty: a name or an address is too long to be kept
/// Oracle: KeptVehicle.*
[[nodiscard]] std::vector<std::uint8_t> kept_vehicle(const host::MissionFile& file);

/// A mission file with what was kept. Nothing: the bytes are another build's, or none.
[[nodiscard]] std::optional<host::MissionFile> vehicle_of(std::span<const std::uint8_t> kept);

}  // namespace earshot::board
