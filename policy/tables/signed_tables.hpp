#pragma once

#include <cstdint>
#include <vector>

#include "firmware/host/trust/keys.hpp"
#include "firmware/policy/tables/ocean_tables.hpp"

namespace earshot::tables {

/// The bytes of a `.tables` file, signed: Ed25519 over every byte before the signature.
/// Throws host::BadInput for tables that a vehicle would refuse.
[[nodiscard]] std::vector<std::uint8_t> sign(const policy::OceanTables& tables, const host::SecretKey& key);

}  // namespace earshot::tables
