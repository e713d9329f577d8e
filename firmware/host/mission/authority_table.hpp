#pragma once

#include "firmware/authority/mission_manifest.hpp"
#include "firmware/host/mission/mission_file.hpp"
#include "firmware/host/toml/table_reader.hpp"

namespace earshot::host {

/// Reads a mission's table [authority], if it has one, and gives its ports what orders are known by; `file` has its ports already.
/// @param digest   of the mission's bytes
/// @param vehicle  that has a configuration, whose word stands above the mission's; null: it has none
void read_authority(TableReader root, const TomlFile& toml, const authority::Sha256& digest, const VehicleTrust* vehicle,
                    MissionFile& file);

/// To every port that brings orders.
void give_command_proof(MissionFile& file);

}  // namespace earshot::host
