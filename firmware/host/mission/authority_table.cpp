#include "firmware/host/mission/authority_table.hpp"

#include <cmath>
#include <optional>
#include <string>

#include "firmware/host/trust/vehicle_file.hpp"

namespace earshot::host {
namespace {

constexpr const char* kCommandKeyFile = "key_file";
constexpr const char* kAcceptOldMarks = "accept_old_marks";
constexpr const char* kAutopilotTimeout = "autopilot_timeout_s";

void read_own_key(TableReader& table, const TomlFile& toml, MissionFile& file) {
  const std::string key_file = table.text(kCommandKeyFile);
  if (table.is_noted(kCommandKeyFile)) return;
  file.mission.authority.needs_verified_commands = true;
  file.command_key_file = toml.resolve(key_file);
  try {
    file.command_key = CommandKey(file.command_key_file);
  } catch (const BadInput& e) {
    table.problem(kCommandKeyFile, e.what());
  }
}

void read_key(TableReader& table, const TomlFile& toml, const VehicleTrust* vehicle, MissionFile& file) {
  if (!table.has(kCommandKeyFile)) return;
  const bool has_vehicles = vehicle != nullptr && vehicle->command_key;
  if (vehicle == nullptr || (vehicle->reads_own_command_key && !has_vehicles)) return read_own_key(table, toml, file);
  (void)table.text(kCommandKeyFile);
  if (!has_vehicles)
    table.problem(kCommandKeyFile,
                  "no signature covers that key: this vehicle takes the key of its commands from trust.command_key_file in " +
                      vehicle->stated_in + ", which names none");
}

void take_vehicle_id(TableReader& table, const VehicleTrust* vehicle, std::string& vehicle_id) {
  const std::string named = read_vehicle_id(table);
  if (named.empty()) return;
  if (!vehicle_id.empty() && named != vehicle_id)
    table.problem("vehicle_id", "is another vehicle: this one is \"" + vehicle_id + "\" (trust.vehicle_id in " + vehicle->stated_in + ")");
  vehicle_id = named;
}

void read_old_marks(TableReader& table, const VehicleTrust* vehicle, MissionFile& file) {
  if (!table.has(kAcceptOldMarks)) return;
  file.accepts_old_marks = table.boolean_or(kAcceptOldMarks, false);
  if (file.accepts_old_marks && vehicle != nullptr && vehicle->command_key)
    table.problem(kAcceptOldMarks, "is the vehicle's to give, whose key it is: trust.accept_old_marks in " + vehicle->stated_in);
}

void take_vehicles_key(const VehicleTrust& vehicle, MissionFile& file) {
  if (!vehicle.command_key) return;
  file.command_key = vehicle.command_key;
  file.command_key_file = vehicle.command_key_file;
  file.accepts_old_marks = vehicle.accepts_old_marks;
  file.mission.authority.needs_verified_commands = true;
}

}  // namespace

void read_authority(TableReader root, const TomlFile& toml, const authority::Sha256& digest, const VehicleTrust* vehicle,
                    MissionFile& file) {
  std::string vehicle_id = vehicle != nullptr ? vehicle->vehicle_id : std::string();
  if (std::optional<TableReader> table = root.optional_table("authority")) {
    if (table->has(kAutopilotTimeout)) {
      const double timeout_s = table->number(kAutopilotTimeout, Range::between(0.5, 3600.0));
      file.mission.authority.autopilot_timeout = {std::llround(timeout_s * 1e6)};
    }
    read_key(*table, toml, vehicle, file);
    take_vehicle_id(*table, vehicle, vehicle_id);
    read_old_marks(*table, vehicle, file);
  }
  if (vehicle != nullptr) take_vehicles_key(*vehicle, file);
  file.challenge = new_challenge(vehicle_id, digest);
  give_command_proof(file);
}

void give_command_proof(MissionFile& file) {
  for (PortSettings& port : file.ports) {
    port.command_proof.reset();
    if (file.command_key && port.roles.has(Role::kOperator))
      port.command_proof = CommandProof{.key = *file.command_key, .challenge = file.challenge, .accepts_old_marks = file.accepts_old_marks};
  }
}

}  // namespace earshot::host
