#pragma once

#include <vector>

#include "firmware/host/toml/table_reader.hpp"
#include "sim/ocean/environment.hpp"

namespace earshot::ocean {

enum class SeaFloorDepth : bool { kGivenHere, kGivenByBathymetry };

struct SeabedKeys {
  Seabed seabed;  ///< its depth 1 m if that is given by [bathymetry]
  std::vector<SedimentStation> stations;
};

/// The table [seabed] of an environment file.
[[nodiscard]] SeabedKeys read_seabed(host::TableReader table, SeaFloorDepth depth);

}  // namespace earshot::ocean
