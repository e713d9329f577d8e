#include "firmware/host/journal/reading/record_source.hpp"

#include <gtest/gtest.h>

#include <array>
#include <fstream>
#include <iterator>
#include <vector>

#include "tests/firmware/host/journal/known_journal.hpp"
#include "tests/support/temporary_folder.hpp"

namespace earshot::journal {
namespace {

// Each record: header 28, channel "EARSHOT_POLICY" 14, data 3.
constexpr std::uint64_t kRecordBytes = 45;

class RecordSourceTest : public ::testing::Test {
 protected:
  /// So many records of the same size.
  void write(int records) {
    WrittenJournal journal(path_);
    for (int i = 0; i < records; ++i) journal.bytes(after(i), wire::kPolicyChannel, kPolicy);
    journal.close();
  }
  [[nodiscard]] std::vector<char> bytes() const {
    std::ifstream file(path_, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  void replace(const std::vector<char>& bytes) const {
    std::ofstream(path_, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  }
  static std::vector<Entry> all_of(RecordSource& source) {
    std::vector<Entry> entries;
    while (std::optional<Entry> entry = source.next()) entries.push_back(std::move(*entry));
    return entries;
  }

  const support::TemporaryFolder folder_;
  const std::filesystem::path path_ = folder_ / "journal";
};

TEST_F(RecordSourceTest, GivesTheRecordsOfAWholeJournalAndNothingElse) {
  write(3);
  RecordSource source(path_);
  const std::vector<Entry> entries = all_of(source);
  ASSERT_EQ(entries.size(), 3U);
  const auto& last = std::get<Record>(entries[2]);
  EXPECT_EQ(last.number, 2U);
  EXPECT_EQ(last.time, after(2));
  EXPECT_EQ(last.channel, "EARSHOT_POLICY");
  EXPECT_EQ(last.size_bytes, 3U);
  EXPECT_EQ(source.offset(), 3 * kRecordBytes);
  EXPECT_FALSE(source.torn_end());
}

TEST_F(RecordSourceTest, TellsOfRecordsThatAreMissingWithTheirPartsWhichAreAndOfNoOthers) {
  {
    host::Journal journal(folder_ / "journal.lcmlog");
    for (int i = 0; i < 6; ++i) {
      if (i == 1 || i == 2 || i == 3) journal.begin_part();
      ASSERT_EQ(journal.append(after(i), wire::kPolicyChannel, kPolicy), Status::kOk);
      ASSERT_EQ(journal.flush(), Status::kOk);
    }
  }
  std::filesystem::remove(folder_ / "journal.part2.lcmlog");
  std::filesystem::remove(folder_ / "journal.part3.lcmlog");
  RecordSource source(folder_ / "journal.lcmlog");
  const std::vector<Entry> entries = all_of(source);
  ASSERT_EQ(entries.size(), 5U);
  const auto& missing = std::get<MissingRecords>(entries[1]);
  EXPECT_EQ(missing.first, 1U);
  EXPECT_EQ(missing.count, 2U);
  EXPECT_EQ(missing.first_part, 2);
  EXPECT_EQ(missing.parts, 2);
}

TEST_F(RecordSourceTest, TellsDamageAndTheRecordThatItHitBeforeWhatFollows) {
  write(4);
  std::vector<char> damaged = bytes();
  damaged[2 * kRecordBytes - 1] ^= 1;
  replace(damaged);
  RecordSource source(path_);
  const std::vector<Entry> entries = all_of(source);
  ASSERT_EQ(entries.size(), 5U);
  EXPECT_EQ(std::get<DamagedBytes>(entries[1]).offset, kRecordBytes);
  EXPECT_EQ(std::get<DamagedBytes>(entries[1]).bytes, kRecordBytes);
  const auto& missing = std::get<MissingRecords>(entries[2]);
  EXPECT_EQ(missing.first, 1U);
  EXPECT_EQ(missing.count, 1U);
  EXPECT_TRUE(missing.was_damaged);
  EXPECT_EQ(std::get<Record>(entries[3]).number, 2U);
}

TEST_F(RecordSourceTest, TellsRecordsThatTheDiskDidNotTake) {
  write(5);
  std::vector<char> shorter = bytes();
  shorter.erase(shorter.begin() + kRecordBytes, shorter.begin() + 3 * kRecordBytes);
  replace(shorter);
  RecordSource source(path_);
  const std::vector<Entry> entries = all_of(source);
  ASSERT_EQ(entries.size(), 4U);
  const auto& missing = std::get<MissingRecords>(entries[1]);
  EXPECT_EQ(missing.first, 1U);
  EXPECT_EQ(missing.count, 2U);
  EXPECT_FALSE(missing.was_damaged);
}

TEST_F(RecordSourceTest, TellsNumbersThatGoBack) {
  write(3);
  std::vector<char> twice = bytes();
  const std::vector<char> once = twice;
  twice.insert(twice.end(), once.begin(), once.end());
  replace(twice);
  RecordSource source(path_);
  const std::vector<Entry> entries = all_of(source);
  ASSERT_EQ(entries.size(), 7U);
  EXPECT_EQ(std::get<NumbersGoBack>(entries[3]).from, 2U);
  EXPECT_EQ(std::get<NumbersGoBack>(entries[3]).to, 0U);
}

TEST_F(RecordSourceTest, TellsTheEndOfAJournalThatWasCut) {
  write(3);
  std::filesystem::resize_file(path_, 2 * kRecordBytes + 30);
  RecordSource source(path_);
  EXPECT_EQ(all_of(source).size(), 2U);
  const std::optional<TornEnd> end = source.torn_end();
  ASSERT_TRUE(end);
  EXPECT_TRUE(end->is_cut);
  EXPECT_EQ(end->where.offset, 2 * kRecordBytes);
  EXPECT_EQ(end->where.bytes, 30U);
}

TEST_F(RecordSourceTest, ReadsOnWhereARecordWasHalfWrittenWhenItIsWhole) {
  write(3);
  const std::vector<char> whole = bytes();
  std::filesystem::resize_file(path_, 2 * kRecordBytes + 30);
  RecordSource source(path_);
  EXPECT_EQ(all_of(source).size(), 2U);
  replace(whole);
  source.resume_reading();
  const std::vector<Entry> rest = all_of(source);
  ASSERT_EQ(rest.size(), 1U);
  EXPECT_EQ(std::get<Record>(rest[0]).number, 2U);
  EXPECT_FALSE(source.torn_end());
}

}  // namespace
}  // namespace earshot::journal
