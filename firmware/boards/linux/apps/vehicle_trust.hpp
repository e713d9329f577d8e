#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

#include "firmware/desk/checklist/checklist.hpp"
#include "firmware/host/mission/mission_file.hpp"
#include "firmware/host/mission/mission_judge.hpp"
#include "firmware/host/mission/ports/port_override.hpp"

namespace earshot::board {

enum class Venture : std::uint8_t { kAtSea, kChecklist, kSimulation };

/// Who judges the mission of a flight: the named configuration of a vehicle, else the one at its usual place, else the mission itself,
/// which standard error warns of in one line. A simulation moves no vehicle: unless a configuration is named, it flies anybody's mission.
/// Elsewhere nobody but root and the user of this program may be able to change the configuration, or what it names.
/// @throws host::BadInput as host::load_vehicle() and host::require_strict_modes()
[[nodiscard]] host::MissionJudge judge_of(const std::optional<std::filesystem::path>& vehicle, Venture venture);

/// What a command line says in place of a mission.
struct SaidInstead {
  bool policy = false;
  bool tables = false;
  bool public_key = false;
  bool seed = false;
  const host::PortOverride& ports;
};

/// What is signed is flown as it stands; but a simulator has ports of its own.
/// @throws host::BadInput naming the option
void require_as_signed(const host::MissionJudge& judge, const SaidInstead& said, Venture venture);

/// Of what has been loaded and judged.
[[nodiscard]] Signatures signatures_of(const host::MissionJudge& judge, const host::SignedSearch& search);

}  // namespace earshot::board
