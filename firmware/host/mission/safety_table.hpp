#pragma once

#include <optional>
#include <vector>

#include "firmware/config/mission.hpp"
#include "firmware/host/toml/table_reader.hpp"

namespace earshot::host {

/// The tables of the safety supervisor, each of which may be left out: [vehicle], [fence], [[no_surface]], [safe_point], [[rule]].
struct SafetyTables {
  std::optional<TableReader> vehicle;
  std::optional<TableReader> fence;
  std::vector<TableReader> no_surface;
  std::optional<TableReader> safe_point;
  std::vector<TableReader> rules;
};

[[nodiscard]] SafetyTables safety_tables(TableReader root);

[[nodiscard]] config::Safety read_safety(SafetyTables& tables);

/// Notes how the safety part does not fit itself or the rest of a mission that is right so far.
/// @param search  the table of that name, which is named where the vehicle and the search do not fit each other
void check_safety(SafetyTables& tables, TableReader root, const TableReader& search, const config::Mission& mission);

}  // namespace earshot::host
