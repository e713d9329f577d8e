#pragma once

#include "firmware/host/toml/table_reader.hpp"
#include "sim/ocean/conditions.hpp"

namespace earshot::ocean {

/// The table [conditions] of an environment file; README.md lists its keys.
[[nodiscard]] Conditions read_conditions(host::TableReader table);

}  // namespace earshot::ocean
