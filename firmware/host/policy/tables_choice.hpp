#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "firmware/policy/tables/ocean_tables.hpp"

namespace earshot::host {

/// A `.tables` file as it was read. Nobody has looked at its signature.
struct TablesFile {
  std::filesystem::path path;
  std::vector<std::uint8_t> bytes;  ///< for whoever does
  std::unique_ptr<policy::OceanTables> tables;
};

/// Reads the files named, and of a folder every `.tables` in it, by name.
/// @throws BadInput naming a folder without any, or the file that is not there or is none
[[nodiscard]] std::vector<TablesFile> read_tables_files(std::span<const std::filesystem::path> named);

/// The file whose tables are of a sound (policy::coverage): of several the one that was made for the nearest depth, by ratio; of equally
/// near ones likewise for the frequency; else the first.
/// @param asked_by  begins the message: "--tables: world rock"
/// @throws BadInput in one line where none is: what was asked, and depths, frequencies and reach of all there are
/// Oracle: TablesChoice.*
[[nodiscard]] const TablesFile& tables_for(std::span<const TablesFile> files, const policy::SearchedSound& sound,
                                           const std::string& asked_by);
/// The same of files and folders that are yet to be read.
[[nodiscard]] TablesFile tables_for(std::span<const std::filesystem::path> named, const policy::SearchedSound& sound,
                                    const std::string& asked_by);

}  // namespace earshot::host
