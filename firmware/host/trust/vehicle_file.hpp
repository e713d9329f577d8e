#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "firmware/host/toml/table_reader.hpp"
#include "firmware/host/trust/key_file.hpp"

namespace earshot::host {

/// Where a vehicle's configuration stands when nobody names another.
inline constexpr const char* kVehicleFile = "/etc/earshot/vehicle.toml";

/// A vehicle's own configuration: whom it trusts. It is its owner's, and no mission can change it.
struct VehicleFile {
  std::filesystem::path path;
  std::vector<TrustedKey> policy_keys;                    ///< whose policies it flies
  std::vector<TrustedKey> mission_keys;                   ///< whose missions it flies
  bool requires_signed_mission = true;                    ///< false: anybody's
  std::filesystem::path counter_file;                     ///< what it flew last; none where missions need no signature
  std::optional<std::filesystem::path> command_key_file;  ///< secret of those who may command it, whatever a mission names
  std::string vehicle_id;                                 ///< its name, which orders are marked for; empty: it has none
  bool accepts_old_marks = false;                         ///< of orders: made without the vehicle's challenge
};

/// The name under `vehicle_id` of a vehicle's configuration or of a mission. Empty: there is none, or what is there can be none, which is
/// noted.
[[nodiscard]] std::string read_vehicle_id(TableReader& table);

/// @throws BadInput with everything that is wrong with the file, and for a trusted key that is none.
[[nodiscard]] VehicleFile load_vehicle(const std::filesystem::path& path);

/// All files that say whom it trusts: itself, public keys, the counter, the key of commands.
[[nodiscard]] std::vector<std::filesystem::path> files_of(const VehicleFile& vehicle);

/// `named`; else the file at the usual place, if anything is there, readable or not: a vehicle does not forget whom it trusts because of a
/// disk's whim.
[[nodiscard]] std::optional<std::filesystem::path> vehicle_file_of(const std::optional<std::filesystem::path>& named,
                                                                   const std::filesystem::path& usual = kVehicleFile);

}  // namespace earshot::host
