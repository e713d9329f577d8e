#include "firmware/boards/linux/apps/vehicle_trust.hpp"

#include <iostream>
#include <string>

#include "firmware/host/file/bad_input.hpp"
#include "firmware/host/trust/strict_modes.hpp"
#include "firmware/host/trust/vehicle_file.hpp"

namespace earshot::board {
namespace {

/// Of a file that others could have written nothing is read.
host::VehicleFile load_strictly(const std::filesystem::path& file) {
  host::require_strict_modes({file});
  host::VehicleFile vehicle = host::load_vehicle(file);
  host::require_strict_modes(host::files_of(vehicle));
  return vehicle;
}

void refuse_if(bool is_given, const std::string& option) {
  if (is_given) throw host::BadInput(option + ": not with a vehicle's configuration, which flies what is signed only as it was signed");
}

}  // namespace

host::MissionVerifier verifier_at_sea(const std::optional<std::filesystem::path>& vehicle, host::Counting counting) {
  if (const std::optional<std::filesystem::path> file = host::vehicle_file_of(vehicle); file) return {load_strictly(*file), counting};
  std::cerr << "earshotd: warning: without --vehicle any mission is flown, whoever wrote it (see Sign missions)\n";
  return {};
}

host::MissionVerifier verifier_in_simulation(const std::optional<std::filesystem::path>& vehicle) {
  if (!vehicle) return {};
  return {host::load_vehicle(*vehicle), host::Counting::kOnlyRead};
}

void require_as_signed(const host::MissionVerifier& verifier, const CommandLineOverrides& overrides) {
  refuse_if(verifier.has_vehicle() && overrides.public_key, "--public-key");
  if (!verifier.requires_signed_mission()) return;
  refuse_if(overrides.policy, "--policy");
  refuse_if(overrides.tables, "--tables");
  refuse_if(overrides.seed, "--seed");
}

void require_ports_as_signed(const host::MissionVerifier& verifier, const host::PortOverride& overrides) {
  if (!verifier.requires_signed_mission()) return;
  refuse_if(overrides.bus.has_value(), "--bus");
  refuse_if(overrides.lcm_url.has_value(), "--lcm-url");
  refuse_if(overrides.hydrophone_url.has_value(), "--hydrophone-url");
  refuse_if(overrides.can_interface.has_value(), "--can-interface");
}

Signatures signatures_of(const host::MissionVerifier& verifier, const host::SignedSearch& search) {
  return {.policy = search.policy.signer,
          .tables = search.tables.signer,
          .mission = verifier.mission_signer(),
          .counter = verifier.manifest() ? verifier.manifest()->counter : 0};
}

}  // namespace earshot::board
