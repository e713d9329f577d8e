#include "policy/own_search/own_policy.hpp"

#include <gtest/gtest.h>

#include "firmware/host/mission/policy_file.hpp"
#include "firmware/host/mission/tables_file.hpp"
#include "firmware/host/policy/policy_bytes.hpp"
#include "tests/support/temporary_folder.hpp"

namespace earshot::own_search {
namespace {

TEST(OwnPolicy, IsTheShippedOneForAnAreaOfAnotherSizeAndSignedWithTheKeyOfItsFolder) {
  const support::TemporaryFolder folder;
  write_own_policy(folder.path(), {.area_north_m = 12'000.0, .area_east_m = 9'000.0});
  const host::SignedPolicy own = host::load_policy(folder.path() / kPolicyFile, folder.path() / "search.pub");
  const std::filesystem::path frozen = std::filesystem::path(EARSHOT_SOURCE_DIR) / "policy/frozen";
  const host::SignedPolicy shipped = host::load_policy(frozen / "shipped.policy", frozen / "earshot.pub");
  EXPECT_EQ(own.policy->area_size, (NorthEast{Meters{12'000.0}, Meters{9'000.0}}));
  EXPECT_EQ(own.policy->step_length, shipped.policy->step_length);
  EXPECT_EQ(own.policy->observation.listening, shipped.policy->observation.listening);
  EXPECT_EQ(own.policy->observation.spec.size(), shipped.policy->observation.spec.size());
  EXPECT_EQ(own.policy->draw, shipped.policy->draw);
}

TEST(OwnPolicy, HasTheShippedTablesOfItsDepthUnderTheKeyOfItsFolder) {
  const support::TemporaryFolder folder;
  write_own_policy(folder.path(), {.area_north_m = 12'000.0, .depth_m = 102.0});
  const host::SignedTables own = host::load_tables(folder.path() / kTablesFile, folder.path() / "search.pub");
  const std::filesystem::path root = EARSHOT_SOURCE_DIR;
  const host::SignedTables shipped = host::load_tables(root / "policy/tables/shipped/20hz_100m.tables", root / "policy/frozen/earshot.pub");
  EXPECT_EQ(own.tables->receiver_depth, Meters{100.0});
  ASSERT_EQ(own.bytes.size(), shipped.bytes.size());
  constexpr std::size_t kKeyAndSignature = 32 + 64;  // all that is another's
  std::size_t different = 0;
  for (std::size_t i = 0; i < own.bytes.size(); ++i) different += own.bytes[i] != shipped.bytes[i] ? 1 : 0;
  EXPECT_LE(different, kKeyAndSignature + 4);  // and the checksum of the section that holds the key
}

TEST(OwnPolicy, HasNoTablesWhereNoneThatShipAreOfTheSearchOrOnesOwnAreAskedFor) {
  for (const OwnSearch& search : {OwnSearch{.depth_m = 200.0, .frequency_hz = 35.0}, OwnSearch{.own_tables = true}}) {
    const support::TemporaryFolder folder;
    write_own_policy(folder.path(), search);
    const host::SignedPolicy own = host::load_policy(folder.path() / kPolicyFile, folder.path() / "search.pub");
    EXPECT_NO_THROW(host::require_repeats_golden(*own.policy, kPolicyFile));
    EXPECT_FALSE(std::filesystem::exists(folder.path() / kTablesFile));
  }
}

TEST(FliesBy, IsWhatShipsForItsSizeAndEveryDepthAndFrequencyOfItsTables) {
  EXPECT_EQ(flies_by({}), FliesBy::kWhatShips);
  EXPECT_EQ(flies_by({.depth_m = 200.0, .frequency_hz = 20.5}), FliesBy::kWhatShips);
  EXPECT_EQ(flies_by({.depth_m = 100.0, .frequency_hz = 35.0}), FliesBy::kWhatShips);
  EXPECT_EQ(flies_by({.area_north_m = 24'000.0}), FliesBy::kOwnPolicy);
}

TEST(FliesBy, IsTablesToBeMadeWhereNoneThatShipAreOfDepthFrequencyOrReach) {
  EXPECT_EQ(flies_by({.depth_m = 200.0, .frequency_hz = 35.0}), FliesBy::kTablesToBeMade);
  EXPECT_EQ(flies_by({.depth_m = 364.0}), FliesBy::kTablesToBeMade);
  EXPECT_EQ(flies_by({.frequency_hz = 22.0}), FliesBy::kTablesToBeMade);
  EXPECT_EQ(flies_by({.area_north_m = 34'000.0, .area_east_m = 34'000.0}), FliesBy::kTablesToBeMade);
  EXPECT_EQ(flies_by({.own_tables = true}), FliesBy::kTablesToBeMade);
}

}  // namespace
}  // namespace earshot::own_search
