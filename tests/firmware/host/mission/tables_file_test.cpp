#include "firmware/host/mission/tables_file.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
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

class TablesFile : public testing::Test {
 protected:
  void SetUp() override {
    support::write_public_key(key_ = folder_ / "key.pub");
    tables_ = folder_ / "a.tables";
  }

  /// What load_tables says about these bytes; empty when it takes them.
  std::string complaint(const Bytes& bytes) {
    support::write_bytes(tables_, bytes);
    return complaint();
  }
  std::string complaint() {
    try {
      (void)load_tables(tables_, key_);
      return "";
    } catch (const BadInput& e) {
      return e.what();
    }
  }
  [[nodiscard]] std::string not_signed() const {
    return tables_.string() + ": is not signed by the trusted key " + key_.string() +
           "; --public-key names the public half of the key that signed it";
  }

  const support::TemporaryFolder folder_;
  const Bytes whole_ = support::signed_bytes(policy::made_up_tables());
  std::filesystem::path key_;
  std::filesystem::path tables_;
};

TEST_F(TablesFile, IsTakenWhenItIsWholeAndSignedByTheTrustedKey) {
  support::write_bytes(tables_, whole_);
  const SignedTables loaded = load_tables(tables_, key_);
  EXPECT_EQ(loaded.tables->tables.size(), 2U);
  EXPECT_EQ(loaded.bytes, whole_);
  EXPECT_EQ(loaded.signer, key_);
}

TEST_F(TablesFile, IsRefusedAsMissingByName) {
  EXPECT_EQ(complaint(), tables_.string() + ": no such file");
}

TEST_F(TablesFile, IsRefusedForItsChecksumWhenABitInTheMiddleIsFlipped) {
  Bytes bytes = whole_;
  bytes[bytes.size() / 2] ^= 1U;
  EXPECT_EQ(complaint(bytes), tables_.string() + ": is damaged: its CRC-32 is wrong");
}

TEST_F(TablesFile, IsRefusedWhenItsSignatureIsNotOfItsBytesOrThereIsNone) {
  Bytes bytes = whole_;
  bytes.back() ^= 1U;
  EXPECT_EQ(complaint(bytes), not_signed());
  std::fill(bytes.end() - 64, bytes.end(), std::uint8_t{0});
  EXPECT_EQ(complaint(bytes), not_signed());
}

TEST_F(TablesFile, IsRefusedWhenAnotherKeyIsTrusted) {
  std::ofstream(key_) << std::string(64, 'a') << "\n";
  EXPECT_EQ(complaint(whole_), not_signed());
}

TEST_F(TablesFile, IsRefusedWhenItIsCutAnywhere) {
  for (std::size_t size = 0; size < whole_.size(); size += 7)
    EXPECT_EQ(complaint({whole_.begin(), whole_.begin() + static_cast<std::ptrdiff_t>(size)}), tables_.string() + ": is cut short") << size;
}

TEST_F(TablesFile, NamesTheSignerAmongSeveralThatAreTrusted) {
  const TrustedKey other{.key = {1, 2, 3}, .file = "other.pub"};
  const TrustedKey signer{.key = support::public_key(), .file = "signer.pub"};
  EXPECT_EQ(signed_tables_from(whole_, "a.tables", {other, signer}, "policy_keys of v.toml").signer, "signer.pub");
  try {
    (void)signed_tables_from(whole_, "a.tables", {other}, "policy_keys of v.toml");
    FAIL();
  } catch (const BadInput& e) {
    EXPECT_TRUE(support::tells(e.what(), {"a.tables", "signed", "none", "policy_keys", "v.toml", "other.pub"}));
  }
}

/// What is said of tables of 20 Hz at 300 m that reach 200 m; empty when they cover the sound.
std::string uncovered(double depth_m, double frequency_hz, double furthest_m) {
  try {
    require_coverage(policy::made_up_tables(), "a.tables",
                     {.vehicle_depth = Meters{depth_m}, .frequency = Hertz{frequency_hz}, .furthest = Meters{furthest_m}});
    return "";
  } catch (const BadInput& e) {
    return e.what();
  }
}

TEST(RequireCoverage, NamesWhatTheTablesAreOfAndWhatTheMissionAsks) {
  EXPECT_EQ(uncovered(290.0, 20.5, 200.0), "");
  EXPECT_TRUE(support::tells(uncovered(100.0, 20.0, 200.0), {"a.tables", "300 m", "270 to 330 m", "100 m"}));
  EXPECT_TRUE(support::tells(uncovered(300.0, 40.0, 200.0), {"a.tables", "20 Hz", "19 to 21 Hz", "40 Hz"}));
  EXPECT_TRUE(support::tells(uncovered(300.0, 20.0, 35'355.5), {"a.tables", "200 m", "35355.5 m"}));
}

}  // namespace
}  // namespace earshot::host
