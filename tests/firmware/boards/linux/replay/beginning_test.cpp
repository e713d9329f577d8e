#include "firmware/boards/linux/replay/beginning.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <functional>
#include <optional>

#include "firmware/core/crc32.hpp"
#include "firmware/host/journal/journal.hpp"
#include "firmware/wire/lcm/channels.hpp"
#include "firmware/wire/lcm/encoding.hpp"
#include "tests/firmware/runtime/mission_rig.hpp"
#include "tests/support/signed_policy.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text/tells.hpp"
#include "tests/support/three_oceans.hpp"

namespace earshot::board {
namespace {

using Bytes = std::vector<std::uint8_t>;

class BeginningTest : public testing::Test {
 protected:
  BeginningTest() {
    message_.policy_crc32 = crc32(policy_);
    message_.tables_crc32 = crc32(tables_);
  }

  /// What the journal says of it; nothing: it was read.
  std::optional<std::string> refusal() {
    const std::filesystem::path path = folder_ / "journal.lcmlog";
    {
      host::Journal journal(path, {.existing = host::ExistingJournal::kReplace});
      const wire::Encoded mission(message_, Time{5});
      (void)journal.append(Time{5}, wire::kMissionChannel, mission.bytes(), host::Priority::kOrder);
      (void)journal.append(Time{5}, wire::kPolicyChannel, policy_, host::Priority::kOrder);
      if (third_) (void)journal.append(Time{5}, *third_, tables_, host::Priority::kOrder);
      (void)journal.close();
    }
    host::JournalReader reader(path);
    try {
      read_ = read_beginning(reader, path);
    } catch (const host::BadInput& e) {
      return e.what();
    }
    return std::nullopt;
  }

  support::TemporaryFolder folder_;
  messages::MissionRecord message_{.mission = runtime::paper_mission()};
  Bytes policy_ = support::signed_bytes(*runtime::frozen(*runtime::policy_that_believes()));
  Bytes tables_ = support::signed_bytes(*support::three_oceans({Meters{25'000}, Meters{25'000}}));
  std::optional<std::string_view> third_ = wire::kTablesChannel;
  Beginning read_;
};

TEST_F(BeginningTest, GivesMissionPolicyAndTablesBack) {
  ASSERT_EQ(refusal(), std::nullopt);
  EXPECT_EQ(read_.time, Time{5});
  EXPECT_EQ(read_.flown.mission, runtime::paper_mission());
  EXPECT_EQ(read_.flown.policy_crc32, crc32(policy_));
  EXPECT_EQ(read_.flown.tables_crc32, crc32(tables_));
  EXPECT_TRUE(policy::needs_belief(read_.policy->observation.spec));
  ASSERT_EQ(read_.tables->tables.size(), 3U);
  EXPECT_EQ(read_.tables->tables[1].snr_half_db[7], 93) << "half a decibel less from range to range";
}

TEST_F(BeginningTest, HasNoOceanWhereThePolicyNeedsNone) {
  tables_.clear();
  message_.tables_crc32 = 0;
  ASSERT_EQ(refusal(), std::nullopt);
  EXPECT_TRUE(read_.tables->tables.empty());
}

TEST_F(BeginningTest, IsRefusedWhereTablesAreMissingOrOthersThanItsMissionNames) {
  third_.reset();
  EXPECT_TRUE(support::has_line(refusal().value_or(""), {"cannot", "replayed", "third", "no", "file"}));
  third_ = wire::kPolicyChannel;
  EXPECT_NE(refusal().value_or("").find("its third record is no tables file"), std::string::npos);
  third_ = wire::kTablesChannel;
  tables_[100] ^= 1U;
  EXPECT_TRUE(support::has_line(refusal().value_or(""), {"file", "not", "mission", "names"}));
  message_.tables_crc32 = crc32(tables_);
  EXPECT_TRUE(support::has_line(refusal().value_or(""), {"file", "damaged", "CRC-32", "wrong"}));
}

TEST_F(BeginningTest, IsRefusedWherePolicyIsAnotherThanItsMissionNames) {
  policy_[100] ^= 1U;
  EXPECT_TRUE(support::has_line(refusal().value_or(""), {"policy", "not", "mission", "names"}));
}

}  // namespace
}  // namespace earshot::board
