// `.tables` files with a checksum and a signature that hold, loaded.
//
// The input: a row of changes to the bytes of good tables (see spoil()). Then the checksum is mended, and the file is signed.

#include <algorithm>
#include <cstddef>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "firmware/host/file/bad_input.hpp"
#include "firmware/host/mission/tables_file.hpp"
#include "firmware/policy/envelope/envelope.hpp"
#include "tests/firmware/policy/tables/made_up_tables.hpp"
#include "tests/fuzz/targets/fuzz_target.hpp"
#include "tests/support/signed_policy.hpp"

namespace earshot::fuzz {

void judge(std::span<const std::uint8_t> input_bytes) {
  static const std::vector<std::uint8_t> good = support::signed_bytes(policy::made_up_tables());
  static const host::TrustedKey trusted{.key = support::public_key(), .file = "a.pub"};
  Input input(input_bytes);
  std::vector<std::uint8_t> bytes = good;
  while (!input.is_used_up()) spoil(bytes, input);
  support::mend(bytes);
  try {
    const host::SignedTables loaded = host::signed_tables_from(std::move(bytes), "a.tables", trusted);
    require(policy::has_valid_shape(*loaded.tables) && policy::has_valid_numbers(*loaded.tables), "tables that cannot be were taken");
    for (const policy::OceanTable& table : loaded.tables->tables)
      require(table.snr_db(loaded.tables->range_count - 1U) >= policy::kLeastTableSnr_db, "an SNR is fainter than a table can hold");
  } catch (const host::BadInput& refusal) {
    require_names_file(refusal.what(), "a.tables: ");
  }
}

}  // namespace earshot::fuzz
