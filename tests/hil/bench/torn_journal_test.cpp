#include "hil/bench/torn_journal.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <string>

#include "firmware/host/journal/journal.hpp"
#include "firmware/host/journal/journal_reader.hpp"
#include "firmware/wire/lcm/channels.hpp"
#include "firmware/wire/lcm/encoding.hpp"
#include "tests/support/temporary_folder.hpp"

namespace earshot::hil {
namespace {

/// A journal of ten turns.
class TornJournalTest : public testing::Test {
 protected:
  TornJournalTest() {
    host::Journal journal(path_);
    const wire::Encoded health(messages::Health{}, Time{});
    for (std::int64_t turn = 1; turn <= 10; ++turn)
      EXPECT_EQ(journal.append(Time{turn * 1'000'000}, wire::kHealthChannel, health.bytes()), Status::kOk);
  }
  [[nodiscard]] int turns() const {
    host::JournalReader reader(path_);
    int count = 0;
    for (host::JournalRecord record; reader.next(record);) ++count;
    return count;
  }

  const support::TemporaryFolder folder_;
  const std::filesystem::path path_ = folder_ / "journal.lcmlog";
};

TEST_F(TornJournalTest, HasLostTheTurnWhoseLastByteIsGone) {
  EXPECT_EQ(tear_journal(path_, 1), 9U);
  EXPECT_EQ(turns(), 9);
}

TEST_F(TornJournalTest, HasLostNoTurnThatEndsWhereItEnds) {
  EXPECT_EQ(tear_journal(path_, 0), 10U);
  EXPECT_EQ(turns(), 10);
}

TEST_F(TornJournalTest, HoldsNothingWhereItHadNoMoreToLose) {
  EXPECT_EQ(tear_journal(path_, 1'000'000), 0U);
  EXPECT_EQ(std::filesystem::file_size(path_), 0U);
}

TEST_F(TornJournalTest, HasOneOtherBitInItsMiddleAndIsAsLong) {
  const auto bytes = [this] {
    std::ifstream file(path_, std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(file), {});
  };
  const std::string before = bytes();
  flip_bit(path_);
  const std::string after = bytes();
  ASSERT_EQ(after.size(), before.size());
  std::size_t others = 0;
  for (std::size_t i = 0; i < before.size(); ++i) {
    if (before[i] == after[i]) continue;
    EXPECT_EQ(before[i] ^ after[i], 1) << i;
    ++others;
  }
  EXPECT_EQ(others, 1U);
  EXPECT_EQ(turns(), 9) << "the record that it is in";
}

}  // namespace
}  // namespace earshot::hil
