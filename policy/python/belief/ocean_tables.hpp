#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "firmware/policy/tables/ocean_tables.hpp"
#include "policy/tables/ocean_curve.hpp"
#include "sim/ocean/environment.hpp"

namespace earshot::python {

/// What tables are made of, as Python gives it.
struct TablesAsked {
  /// Environments, and files of them.
  std::vector<std::variant<std::shared_ptr<ocean::Environment>, std::filesystem::path>> oceans;
  tables::CurvePlan plan;
  std::size_t at_most;
};

/// Ocean tables, and the bytes of their file. Nothing of them changes. The signature is not looked at.
struct Tables {
  std::shared_ptr<const policy::OceanTables> of;
  std::vector<std::uint8_t> bytes;
};

/// @param name  of the file, for what is said of it. Throws host::BadInput for bytes that are none.
[[nodiscard]] Tables tables_of(std::vector<std::uint8_t> bytes, const std::filesystem::path& name);

/// As `earshot tables` makes them of what it calls ENVIRONMENT, but for the signature and what the provenance says of the program.
/// Throws host::BadInput for oceans of several frequencies, and where one has no water at the vehicle's depth.
[[nodiscard]] Tables make_tables(const TablesAsked& asked, const std::function<void(double share)>& progress);

}  // namespace earshot::python
