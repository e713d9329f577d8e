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
  EXPECT_EQ(complaint_after([](Bytes& bytes) { bytes[kOceansAt] = 'X'; }),
            "a.tables: section XCNS is a section this program does not know");
  EXPECT_EQ(complaint_after([](Bytes& bytes) { bytes[kOceansAt + 4] = 7; }),
            "a.tables: section OCNS, version 7, is of a version this program does not know");
  EXPECT_EQ(complaint_after([](Bytes& bytes) { bytes[kOceansAt + 6] ^= 1U; }), "a.tables: section OCNS is not as long as what it holds");
  EXPECT_EQ(complaint_after([](Bytes& bytes) { bytes[kRangeCountAt + 1] = 0xFF; }),
            "a.tables: section GRID has a size that is zero, contradicts another or exceeds what this program holds: 96 tables of 512 "
            "ranges, names of 32 bytes, 1024 bytes of provenance");
  EXPECT_EQ(complaint_about({}), "a.tables: is cut short");
}

TEST(TablesBytes, AreRefusedWhereANumberIsNone) {
  const auto not_a_number = [](Bytes& bytes) {
    for (std::size_t i = 0; i < 8; ++i) bytes[kFrequencyAt + i] = 0xFF;
  };
  EXPECT_EQ(complaint_after(not_a_number),
            "a.tables: section GRID holds a number that is out of its range: frequency in Hz = nan (1 to 10000)");
  const policy::OceanTables made_up = policy::made_up_tables();
  const std::string name{made_up.tables[0].name.begin(), made_up.tables[0].name.end()};
  EXPECT_EQ(complaint_after([&name](Bytes& bytes) { put(bytes, kFirstNameAt + name.size(), 0.0F); }),
            "a.tables: section OCNS holds a number that is out of its range: prior of \"" + name + "\" = 0 (1e-06 to 1e+06)");
  const auto upside_down = [](Bytes& bytes) {
    put(bytes, kSeaDepthAt, 900.0);
    put(bytes, kSeaDepthAt + sizeof(double), 800.0);
  };
  EXPECT_EQ(complaint_after(upside_down),
            "a.tables: section GRID holds a number that is out of its range: greatest depth of the sea floor = 800 (900 to 12000)");
}

TEST(TablesBytes, OfAnotherKindOrVersionSaySo) {
  EXPECT_EQ(complaint_about(support::signed_bytes(support::random_walk_policy())), "a.tables: is not a .tables file");
  EXPECT_EQ(complaint_after([](Bytes& bytes) { bytes[8] = 2; }),
            "a.tables: is of version 2 of the .tables format, this program reads version 1: it was made by a later one");
  EXPECT_EQ(complaint_after([](Bytes& bytes) { bytes[8] = 0; }),
            "a.tables: is of version 0 of the .tables format, this program reads version 1; make it again with earshot tables");
}

TEST(TablesBytes, AreRefusedWhenAPersonCouldNotReadTheirWords) {
  EXPECT_EQ(complaint_after([](Bytes& bytes) { bytes[kFirstNameAt] = 0xFF; }), "a.tables: section OCNS holds a name that is not UTF-8");
  const auto provenance_without_an_end = [](Bytes& bytes) { bytes[bytes.size() - 100 - 1] = ' '; };
  EXPECT_EQ(complaint_after(provenance_without_an_end), "a.tables: section PROV ends within a line");
}

TEST(ReadTablesBytes, RefusesAFileThatIsNotThereOrLargerThanAny) {
  const support::TemporaryFolder folder;
  EXPECT_THROW((void)read_tables_bytes(folder / "none.tables"), BadInput);
  support::write_bytes(folder / "large.tables", Bytes(60'000));
  EXPECT_THROW((void)read_tables_bytes(folder / "large.tables"), BadInput);
}

}  // namespace
}  // namespace earshot::host
