#pragma once

#include <filesystem>
#include <optional>

#include "firmware/desk/checklist/checklist.hpp"
#include "firmware/host/mission/mission_file.hpp"
#include "firmware/host/mission/mission_verifier.hpp"
#include "firmware/host/mission/ports/port_override.hpp"

namespace earshot::board {

/// Who judges the mission of a flight at sea: the named configuration of a vehicle, else the one at its usual place, else the mission
/// itself, which standard error warns of in one line. Nobody but root and the user of this program may be able to change the
/// configuration, or what it names. @param counting  what becomes of the counters of what is signed
/// @throws host::BadInput as host::load_vehicle() and host::require_strict_modes()
[[nodiscard]] host::MissionVerifier verifier_at_sea(const std::optional<std::filesystem::path>& vehicle, host::Counting counting);

/// A simulation moves no vehicle: unless a configuration is named, it flies anybody's mission.
/// @throws host::BadInput as host::load_vehicle()
[[nodiscard]] host::MissionVerifier verifier_in_simulation(const std::optional<std::filesystem::path>& vehicle);

/// What a command line says in place of a mission.
struct CommandLineOverrides {
  bool policy = false;
  bool tables = false;
  bool public_key = false;
  bool seed = false;
};

/// What is signed is flown as it stands.
/// @throws host::BadInput naming the option
void require_as_signed(const host::MissionVerifier& verifier, const CommandLineOverrides& overrides);

/// So are its ports at sea; a simulator has ports of its own.
/// @throws host::BadInput naming the option
void require_ports_as_signed(const host::MissionVerifier& verifier, const host::PortOverride& overrides);

/// Of what has been loaded and judged.
[[nodiscard]] Signatures signatures_of(const host::MissionVerifier& verifier, const host::SignedSearch& search);

}  // namespace earshot::board
