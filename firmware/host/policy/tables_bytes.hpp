#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "firmware/policy/envelope/policy_fault.hpp"
#include "firmware/policy/tables/ocean_tables.hpp"

namespace earshot::host {

/// @throws BadInput naming the file when it is not there, cannot be read or is larger than any `.tables`
[[nodiscard]] std::vector<std::uint8_t> read_tables_bytes(const std::filesystem::path& path);

/// The ocean tables in the bytes of a `.tables` file: whole, of sizes and numbers that can be, with names and provenance that people can
/// read. Their signature is not looked at: a desk may look at any.
/// @param path  what the message calls it
/// @throws BadInput in one line: the file, the section and what is wrong with it
[[nodiscard]] std::unique_ptr<policy::OceanTables> tables_from(std::span<const std::uint8_t> bytes, const std::filesystem::path& path);

/// @throws BadInput as above, for names that are not UTF-8 and provenance that is not lines of text
void require_readable(const policy::OceanTables& tables, const std::filesystem::path& path);

}  // namespace earshot::host
