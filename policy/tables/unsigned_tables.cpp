#include "policy/tables/unsigned_tables.hpp"

#include "firmware/host/file/bad_input.hpp"
#include "firmware/host/policy/tables_bytes.hpp"
#include "firmware/policy/tables/tables_format.hpp"

namespace earshot::tables {

std::vector<std::uint8_t> unsigned_bytes(const policy::OceanTables& tables,
                                         std::span<const std::uint8_t, policy::kPublicKeySize> public_key) {
  host::require_readable(tables, "the tables");
  std::vector<std::uint8_t> bytes(policy::max_tables_size());
  const Result<std::size_t> size = policy::serialise(tables, public_key, bytes);
  if (!size.ok()) throw host::BadInput("the tables do not fit the vehicle: a size, depth, frequency or prior is out of range");
  bytes.resize(size.value());
  return bytes;
}

}  // namespace earshot::tables
