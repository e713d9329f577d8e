#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "firmware/host/policy/tables_choice.hpp"
#include "policy/evaluate/output/figures_json.hpp"
#include "policy/evaluate/world_file.hpp"
#include "sim/search/settings.hpp"

namespace earshot::evaluate {

/// The tables of the option --tables; where it is not given those that ship.
struct TablesGiven {
  std::vector<host::TablesFile> files;
  bool are_named = false;
};

/// @param named  files and folders. Throws host::BadInput naming the file that is none.
[[nodiscard]] TablesGiven read_tables(const std::vector<std::string>& named);

/// For each world the file of the oceans that are believed possible there; null: the environment's own ocean alone, where no tables that
/// ship are of the world's depth and frequency. Throws host::BadInput where none of those named are.
/// @param worlds    know how deep their vehicle is
/// @param warnings  gets a sentence for each world without tables, and for each file whose signature does not hold
/// Oracle: TablesForEvaluate.*
[[nodiscard]] std::vector<const host::TablesFile*> tables_of_worlds(const TablesGiven& given, std::span<const WorldFile> worlds,
                                                                    const search::SearchSettings& settings,
                                                                    std::vector<std::string>& warnings);

/// What the figures say of tables. @param file  null: nothing
[[nodiscard]] std::optional<FlownTables> described(const host::TablesFile* file);

}  // namespace earshot::evaluate
