#pragma once

#include "firmware/config_file/table_reader.hpp"
#include "sim/ocean/conditions.hpp"

namespace earshot::ocean {

/// The table [conditions] of an environment file; README.md lists its keys.
[[nodiscard]] Conditions read_conditions(config_file::TableReader table);

}  // namespace earshot::ocean
