#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "firmware/config/mission.hpp"
#include "firmware/core/time.hpp"
#include "firmware/detector/hydrophone/settings.hpp"
#include "firmware/host/mission/port_settings.hpp"
#include "firmware/wire/n2k/local_plane.hpp"

namespace earshot::host {

class TomlFile;

/// What makes a turn of the loop at sea.
enum class Turns : std::uint8_t {
  kPeriodic,   ///< step_period alone
  kOnArrival,  ///< also a fix or an order, at once
};

/// What a mission file says: what the runtime is asked to do, and what this board needs to do it. What a command line changes of its ports
/// (ports/port_override.hpp) and what a flight needs of them (ports/flight_needs.hpp) is apart.
struct MissionFile {
  config::Mission mission;
  Duration step_period;            ///< between two turns of the loop at sea; in lock-step with a simulator every tick is one turn
  Turns turns = Turns::kPeriodic;  ///< likewise at sea
  std::vector<PortSettings> ports;
  std::optional<detector::SoundSettings> hearing;  ///< what the hydrophone's port listens for; none: it counts samples only
  n2k::LocalPlane plane;                           ///< about the mission's geographic origin; CAN speaks latitude and longitude
  std::optional<CommandKey> command_key;           ///< of those who may command the vehicle
  messages::Challenge challenge;                   ///< what their orders are marked for: of this loading of the file
  bool accepts_old_marks = false;                  ///< of their orders: made without the challenge
  std::filesystem::path command_key_file;          ///< that it stands in
  std::filesystem::path policy;
  std::filesystem::path tables;  ///< of the oceans that are possible there: a file, or a folder of which one covers the mission; empty:
                                 ///< those that ship
  std::filesystem::path public_key;
  std::string policy_named_at;      ///< "search.toml:31: policy.file"; empty: somewhere else
  std::string tables_named_at;      ///< the same
  std::string public_key_named_at;  ///< the same
};

/// @throws host::BadInput with everything that is wrong with the file.
[[nodiscard]] MissionFile load_mission(const std::filesystem::path& path);
/// Of a file that is parsed already. @param text  that it was read from
[[nodiscard]] MissionFile load_mission(const TomlFile& file, const std::string& text);

/// What a vehicle that has a configuration says of every mission, whatever that says itself.
struct VehicleTrust {
  std::string stated_in;                        ///< the configuration's file
  std::optional<CommandKey> command_key = {};   ///< of who may command it
  std::filesystem::path command_key_file = {};  ///< that it stands in
  bool reads_own_command_key = false;           ///< of the mission, whose signature covers no other file
  std::string vehicle_id = {};                  ///< its name; empty: the mission's, if that names one
  bool accepts_old_marks = false;               ///< with the vehicle's key
};
/// A mission whose bytes have been read from `path`, for such a vehicle: which key vouches for its policy is not the mission's to say.
[[nodiscard]] MissionFile load_mission(const std::filesystem::path& path, const std::string& text, const VehicleTrust& vehicle);

/// @throws host::BadInput with the mission's line and the path that was tried, when the policy or the key is not there that the
/// mission names. Apart from load_mission, because a command line may name others.
void require_named_files(const MissionFile& file);

}  // namespace earshot::host
