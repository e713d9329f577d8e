#include "firmware/host/policy/tables_bytes.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <functional>
#include <string>
#include <vector>

#include "firmware/host/file/bad_input.hpp"
#include "tests/firmware/policy/tables/made_up_tables.hpp"
#include "tests/support/signed_policy.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text/tells.hpp"

namespace earshot::host {
namespace {

using Bytes = std::vector<std::uint8_t>;

std::string complaint_about(const Bytes& bytes) {
  try {
    (void)tables_from(bytes, "a.tables");
    return "";
  } catch (const BadInput& e) {
    return e.what();
  }
}

/// What is said of the made-up tables after `damage`, their CRC-32 mended.
std::string complaint_after(const std::function<void(Bytes&)>& damage) {
  Bytes bytes = support::signed_bytes(policy::made_up_tables());
  damage(bytes);
  support::mend(bytes);
  return complaint_about(bytes);
}

template <class Number>
void put(Bytes& bytes, std::size_t at, Number number) {
  std::memcpy(&bytes[at], &number, sizeof number);
}

// By firmware/policy/tables/README.md.
constexpr std::size_t kFrequencyAt = 26;
constexpr std::size_t kSeaDepthAt = 58;
constexpr std::size_t kRangeCountAt = 82;
constexpr std::size_t kOceansAt = 84;
constexpr std::size_t kFirstNameAt = 97;

TEST(TablesBytes, AreTablesWhenWhole) {
  EXPECT_EQ(tables_from(support::signed_bytes(policy::made_up_tables()), "a.tables")->tables.size(), 2U);
}

TEST(TablesBytes, AreRefusedWithTheSectionThatIsWrong) {
  EXPECT_TRUE(support::tells(complaint_after([](Bytes& bytes) { bytes[kOceansAt] = 'X'; }), {"a.tables", "XCNS", "not"}));
  EXPECT_TRUE(support::tells(complaint_after([](Bytes& bytes) { bytes[kOceansAt + 4] = 7; }), {"a.tables", "OCNS", "version 7", "not"}));
  EXPECT_TRUE(support::tells(complaint_after([](Bytes& bytes) { bytes[kOceansAt + 6] ^= 1U; }), {"a.tables", "OCNS", "not"}));
  EXPECT_TRUE(support::tells(complaint_after([](Bytes& bytes) { bytes[kRangeCountAt + 1] = 0xFF; }),
                             {"a.tables", "GRID", "holds", "96 tables", "512 ranges", "32 bytes", "1024 bytes"}));
  EXPECT_EQ(complaint_about({}), "a.tables: is cut short");
}

TEST(TablesBytes, AreRefusedWhereANumberIsNone) {
  const auto not_a_number = [](Bytes& bytes) {
    for (std::size_t i = 0; i < 8; ++i) bytes[kFrequencyAt + i] = 0xFF;
  };
  EXPECT_TRUE(support::tells(complaint_after(not_a_number), {"a.tables", "GRID", "range", "Hz", "1 to 10000"}));
  const policy::OceanTables made_up = policy::made_up_tables();
  const std::string name{made_up.tables[0].name.begin(), made_up.tables[0].name.end()};
  EXPECT_TRUE(support::tells(complaint_after([&name](Bytes& bytes) { put(bytes, kFirstNameAt + name.size(), 0.0F); }),
                             {"a.tables", "OCNS", "range", name, "0", "1e-06 to 1e+06"}));
  const auto upside_down = [](Bytes& bytes) {
    put(bytes, kSeaDepthAt, 900.0);
    put(bytes, kSeaDepthAt + sizeof(double), 800.0);
  };
  EXPECT_TRUE(support::tells(complaint_after(upside_down), {"a.tables", "GRID", "range", "floor", "800", "900 to 12000"}));
}

TEST(TablesBytes, OfAnotherKindOrVersionSaySo) {
  EXPECT_EQ(complaint_about(support::signed_bytes(support::random_walk_policy())), "a.tables: is not a .tables file");
  EXPECT_TRUE(support::tells(complaint_after([](Bytes& bytes) { bytes[8] = 2; }), {"a.tables", "version 2", "version 1", "later"}));
  EXPECT_TRUE(support::tells(complaint_after([](Bytes& bytes) { bytes[8] = 0; }), {"a.tables", "version 0", "version 1"}));
}

TEST(TablesBytes, AreRefusedWhenAPersonCouldNotReadTheirWords) {
  EXPECT_TRUE(support::tells(complaint_after([](Bytes& bytes) { bytes[kFirstNameAt] = 0xFF; }), {"a.tables", "OCNS", "not UTF-8"}));
  const auto provenance_without_an_end = [](Bytes& bytes) { bytes[bytes.size() - 100 - 1] = ' '; };
  EXPECT_TRUE(support::tells(complaint_after(provenance_without_an_end), {"a.tables", "PROV", "within"}));
}

TEST(ReadTablesBytes, RefusesAFileThatIsNotThereOrLargerThanAny) {
  const support::TemporaryFolder folder;
  EXPECT_THROW((void)read_tables_bytes(folder / "none.tables"), BadInput);
  support::write_bytes(folder / "large.tables", Bytes(60'000));
  EXPECT_THROW((void)read_tables_bytes(folder / "large.tables"), BadInput);
}

}  // namespace
}  // namespace earshot::host
