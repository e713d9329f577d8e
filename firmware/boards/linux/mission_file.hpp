#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "firmware/config/mission.hpp"
#include "firmware/core/time.hpp"
#include "firmware/wire/n2k/local_plane.hpp"

namespace earshot::board {

inline constexpr const char* kDefaultCanInterface = "can0";  ///< the bus of a vehicle at sea

enum class BusKind : std::uint8_t { kLcm, kCan };

/// A mission file: what the runtime is asked to do, and what this board needs to do it.
struct MissionFile {
  config::Mission mission;
  Duration step_period;  ///< between two turns of the loop at sea; in simulation every tick is one turn
  BusKind bus = BusKind::kLcm;
  std::string lcm_url;
  std::string can_interface;
  n2k::LocalPlane plane;  ///< about the mission's geographic origin; CAN speaks latitude and longitude
  std::filesystem::path policy;
  std::filesystem::path public_key;
};

/// @throws config_file::BadInput with everything that is wrong with the file.
[[nodiscard]] MissionFile load_mission(const std::filesystem::path& path);

}  // namespace earshot::board
