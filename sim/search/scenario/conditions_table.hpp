#pragma once

#include "firmware/host/toml/table_reader.hpp"
#include "sim/search/scenario/conditions.hpp"

namespace earshot::search {

/// The table [conditions] of an environment file; README.md lists its keys.
[[nodiscard]] Conditions read_conditions(host::TableReader table);

}  // namespace earshot::search
