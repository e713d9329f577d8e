#pragma once

#include "firmware/host/toml/table_reader.hpp"
#include "sim/ocean/environment.hpp"

namespace earshot::ocean {

enum class SeaFloorDepth : bool { kGivenHere, kGivenByBathymetry };

/// The table [seabed] of an environment file, into `environment`. Its depth is 1 m if that is given by [bathymetry].
void read_seabed(host::TableReader table, SeaFloorDepth depth, Environment& environment);

}  // namespace earshot::ocean
