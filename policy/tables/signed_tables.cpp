#include "policy/tables/signed_tables.hpp"

#include "firmware/host/trust/signed_bytes.hpp"
#include "policy/tables/unsigned_tables.hpp"

namespace earshot::tables {

std::vector<std::uint8_t> sign(const policy::OceanTables& tables, const host::SecretKey& key) {
  std::vector<std::uint8_t> bytes = unsigned_bytes(tables, host::public_key_of(key));
  host::sign_at_end(bytes, key);
  return bytes;
}

}  // namespace earshot::tables
