#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "firmware/policy/envelope/envelope.hpp"
#include "firmware/policy/tables/ocean_tables.hpp"

namespace earshot::tables {

/// The bytes of a `.tables` file that nobody has signed: a desk reads it, and a vehicle refuses it.
/// Throws host::BadInput for tables that a vehicle would refuse when they are signed.
[[nodiscard]] std::vector<std::uint8_t> unsigned_bytes(const policy::OceanTables& tables,
                                                       std::span<const std::uint8_t, policy::kPublicKeySize> public_key);

}  // namespace earshot::tables
