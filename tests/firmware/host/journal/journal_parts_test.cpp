// Journals of several files: written, read as one, cut, damaged, mistaken for others'.

#include "firmware/host/journal/journal_parts.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include "firmware/host/file/bad_input.hpp"
#include "firmware/host/file/folder_lock.hpp"
#include "firmware/host/journal/journal_name.hpp"
#include "tests/firmware/host/journal/journal_folder.hpp"
#include "tests/support/file_size_limit.hpp"
#include "tests/support/text/tells.hpp"

namespace earshot::host {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kRecordBytes = 28 + 5 + 67;      ///< header, channel, data
constexpr std::size_t kBeginningBytes = 28 + 20 + 16;  ///< of a later part: "EARSHOT_JOURNAL_PART", fingerprint, two numbers

class JournalPartsTest : public JournalFolder {
 protected:
  /// Records of 100 bytes, each in a write of its own, and a new part after every `each`.
  void write(int count, int each, std::uint8_t first = 0, JournalOptions options = {}) {
    Journal journal(path_, options);
    for (int i = 0; i < count; ++i) {
      if (i > 0 && i % each == 0) journal.begin_part();
      ASSERT_EQ(journal.append(Time{i + 1}, "PARTS", Bytes(67, static_cast<std::uint8_t>(first + i))), Status::kOk);
      ASSERT_EQ(journal.flush(), Status::kOk);
    }
    ASSERT_EQ(journal.close(), Status::kOk);
  }
  [[nodiscard]] fs::path part(int number) const { return part_of(path_, number); }
  [[nodiscard]] std::vector<JournalRecord> records() const {
    JournalReader reader(path_);
    std::vector<JournalRecord> all;
    for (JournalRecord record; reader.next(record);) all.push_back(record);
    return all;
  }
  [[nodiscard]] std::vector<std::uint32_t> numbers() const {
    std::vector<std::uint32_t> all;
    for (const JournalRecord& record : records()) all.push_back(record.number);
    return all;
  }
  static void flip(const fs::path& file, std::uint64_t at) {
    std::fstream stream(file, std::ios::binary | std::ios::in | std::ios::out);
    stream.seekg(static_cast<std::streamoff>(at));
    const int byte = stream.get();
    stream.seekp(static_cast<std::streamoff>(at));
    stream.put(static_cast<char>(byte ^ 1));
  }
};

TEST_F(JournalPartsTest, LeaveNothingOfOneForWhichTheDiskHasNoRoomAndTheOneBeforeIsWrittenOn) {
  Journal journal(path_);
  ASSERT_EQ(journal.append(Time{1}, "PARTS", Bytes(67)), Status::kOk);
  ASSERT_EQ(journal.flush(), Status::kOk);
  {
    const support::FileSizeLimit disk(kBeginningBytes - 1);
    journal.begin_part();
    ASSERT_EQ(journal.append(Time{2}, "PARTS", Bytes(67)), Status::kOk);
    ASSERT_EQ(journal.flush(), Status::kNotReady);
    EXPECT_FALSE(fs::exists(part(2)));
  }
  ASSERT_EQ(journal.close(), Status::kOk);
  EXPECT_EQ(numbers(), (std::vector<std::uint32_t>{0, 1}));
  EXPECT_EQ(fs::file_size(path_), 2 * kRecordBytes);
}

TEST_F(JournalPartsTest, AreReadAsOneJournalWhoseNumbersGoOn) {
  write(4, 100);
  const std::vector<JournalRecord> whole = records();
  ASSERT_EQ(whole.size(), 4U);
  write(4, 1, 0, {.existing = ExistingJournal::kReplace});
  for (int number = 2; number <= 4; ++number) EXPECT_EQ(fs::file_size(part(number)), kBeginningBytes + kRecordBytes);
  const std::vector<JournalRecord> parted = records();
  ASSERT_EQ(parted.size(), 4U);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(parted[i].number, whole[i].number);
    EXPECT_EQ(parted[i].data, whole[i].data);
    EXPECT_EQ(parted[i].time, whole[i].time);
  }
  EXPECT_EQ(fs::file_size(path_), kRecordBytes) << "space that was held is let go of";
  JournalReader reader(path_);
  for (JournalRecord record; reader.next(record);) {
  }
  EXPECT_EQ(reader.end(), JournalReader::End::kWhole);
  EXPECT_EQ(reader.offset(), reader.file_size());
}

TEST_F(JournalPartsTest, AreReadThroughALinkToTheFirst) {
  write(4, 2);
  fs::create_directory(folder_ / "elsewhere");
  fs::create_symlink(fs::path("..") / path_.filename(), folder_ / "elsewhere" / "link");
  JournalReader reader(folder_ / "elsewhere" / "link");
  std::size_t count = 0;
  for (JournalRecord record; reader.next(record);) ++count;
  EXPECT_EQ(count, 4U);
}

TEST_F(JournalPartsTest, BeginWhenOneIsFull) {
  {
    Journal journal(path_, {.limits = {.part_bytes = 250}});
    for (int i = 0; i < 12; ++i) {
      ASSERT_EQ(journal.append(Time{i}, "PARTS", Bytes(67)), Status::kOk);
      ASSERT_EQ(journal.flush(), Status::kOk);
    }
  }
  EXPECT_EQ(fs::file_size(path_), 3 * kRecordBytes);
  EXPECT_EQ(fs::file_size(part(2)), kBeginningBytes + 2 * kRecordBytes);
  EXPECT_EQ(numbers(), (std::vector<std::uint32_t>{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11}));
}

TEST_F(JournalPartsTest, OfAnotherJournalAreLeftAlone) {
  write(4, 2, 100);
  ASSERT_TRUE(fs::exists(part(2)));
  fs::remove(path_);
  EXPECT_EQ(newest_journal(path_), std::nullopt);
  { Journal journal(path_, {.existing = ExistingJournal::kReplace}); }
  EXPECT_FALSE(fs::exists(part(2))) << "who replaces a journal replaces all of it";
  write(4, 2, 100, {.existing = ExistingJournal::kReplace});
  const fs::path stale = folder_ / "stale";
  fs::rename(part(2), stale);
  write(2, 2, 1, {.existing = ExistingJournal::kReplace});
  fs::rename(stale, part(2));
  EXPECT_EQ(numbers().size(), 2U) << "it names another first record";
}

TEST_F(JournalPartsTest, AreKeptWithTheirJournalWhoseNumberNobodyElseGets) {
  write(4, 2);
  fs::remove(path_);
  const Journal next(path_, {.existing = ExistingJournal::kKeep});
  EXPECT_EQ(next.path(), folder_ / "journal-2.lcmlog") << "of the first a part is there";
}

TEST_F(JournalPartsTest, AreNotWrittenOverWhatStandsInTheirPlace) {
  std::ofstream(part(2)) << "somebody's notes";
  write(6, 2);
  EXPECT_EQ(numbers().size(), 6U);
  EXPECT_EQ(fs::file_size(part(2)), 16U);
  EXPECT_EQ(fs::file_size(path_), 2 * kRecordBytes);
  EXPECT_TRUE(fs::exists(part(4))) << "the next number is taken";
}

TEST_F(JournalPartsTest, OfAnotherJournalStayWhereThisOneIsCut) {
  write(4, 2, 100);
  const fs::path other = folder_ / "other";
  fs::rename(part(2), other);
  write(2, 2, 1, {.existing = ExistingJournal::kReplace});
  fs::rename(other, part(2));
  JournalFile file(path_, ExistingJournal::kGoOn);
  file.cut(kRecordBytes);
  EXPECT_EQ(fs::file_size(part(2)), kBeginningBytes + 2 * kRecordBytes);
  {
    Journal journal(std::move(file), 1);
    journal.begin_part();
    ASSERT_EQ(journal.append(Time{9}, "PARTS", Bytes(67, 9)), Status::kOk);
  }
  EXPECT_EQ(fs::file_size(part(3)), kBeginningBytes + kRecordBytes);
  EXPECT_EQ(numbers(), (std::vector<std::uint32_t>{0, 1}));
}

TEST_F(JournalPartsTest, ThatAPowerCutLeftEmptyOfContentAreGoneWhereTheJournalIsCut) {
  write(2, 2);
  std::ofstream(part(2)) << std::string(90, '\0');
  JournalFile(path_, ExistingJournal::kGoOn).cut(2 * kRecordBytes);
  EXPECT_FALSE(fs::exists(part(2)));
}

TEST_F(JournalPartsTest, LoseTheRecordThatADamageHitsWhereverItIsAndNoOther) {
  write(6, 2);
  const std::vector<std::uint8_t> first = contents();
  ASSERT_TRUE(fs::exists(part(3)));
  const std::uint64_t first_size = fs::file_size(path_);
  for (const std::uint64_t at : {std::uint64_t{5}, std::uint64_t{60}, first_size - 1}) {
    flip(path_, at);
    EXPECT_EQ(numbers().size(), 5U) << "byte " << at;
    JournalReader reader(path_);
    for (JournalRecord record; reader.next(record);) {
    }
    ASSERT_EQ(reader.damages().size(), 1U);
    EXPECT_EQ(reader.damages()[0].part, "journal.lcmlog");
    flip(path_, at);
  }
  // The beginning of a part, of which no record is lost; then its record.
  for (std::uint64_t at = 0; at < kBeginningBytes + kRecordBytes; at += 7) {
    flip(part(2), at);
    EXPECT_EQ(numbers().size(), at < kBeginningBytes ? 6U : 5U) << "byte " << at;
    JournalReader reader(path_);
    for (JournalRecord record; reader.next(record);) {
    }
    ASSERT_EQ(reader.damages().size(), 1U) << at;
    EXPECT_EQ(reader.damages()[0].part, "journal.part2.lcmlog");
    EXPECT_EQ(reader.damages()[0].offset, at < kBeginningBytes ? 0U : kBeginningBytes);
    flip(part(2), at);
  }
}

TEST_F(JournalPartsTest, AreReadAloneOnlyWhereTheirJournalIsNot) {
  write(3, 1);
  try {
    const JournalReader reader(part(3));
    FAIL() << "it would tell of two records that are missing";
  } catch (const BadInput& refused) {
    EXPECT_TRUE(support::tells(refused.what(), {part(3).string(), "part 3", "journal", path_.string(), "name", "parts", "read"}));
  }
  write(2, 5, 9, {.existing = ExistingJournal::kReplace});
  fs::rename(path_, path_.parent_path() / "other.lcmlog");
  write(3, 1);
  fs::rename(path_.parent_path() / "other.lcmlog", path_);
  JournalReader of_another(part(3));
  JournalRecord record;
  EXPECT_TRUE(of_another.next(record)) << "the journal beside it is another one";
  fs::remove(path_);
  JournalReader alone(part(3));
  EXPECT_TRUE(alone.next(record));
}

TEST_F(JournalPartsTest, ThatAreMissingAreAGapInTheNumbers) {
  write(8, 2);
  fs::remove(part(2));
  fs::remove(part(3));
  EXPECT_EQ(numbers(), (std::vector<std::uint32_t>{0, 1, 6, 7}));
}

TEST_F(JournalPartsTest, ThatBearAnothersNameAreNotReadAndAreFound) {
  write(6, 2);
  EXPECT_EQ(JournalParts(path_).misplaced(), std::nullopt);
  fs::rename(part(3), part(9));
  EXPECT_EQ(numbers(), (std::vector<std::uint32_t>{0, 1, 2, 3}));
  EXPECT_EQ(JournalParts(path_).misplaced(), part(9));
  fs::remove(part(9));
  EXPECT_EQ(JournalParts(path_).misplaced(), std::nullopt);
}

TEST_F(JournalPartsTest, AreWrittenOnWhereTheJournalIsCutAndThoseBehindAreGone) {
  write(6, 2);
  JournalReader reader(path_);
  JournalRecord record;
  for (int i = 0; i < 4; ++i) ASSERT_TRUE(reader.next(record));
  const std::uint64_t kept = reader.offset();
  ASSERT_TRUE(fs::exists(part(3)));
  JournalFile file(path_, ExistingJournal::kGoOn);
  EXPECT_TRUE(fs::exists(part(3))) << "nothing is changed before it is cut";
  file.cut(kept);
  EXPECT_FALSE(fs::exists(part(3)));
  {
    Journal journal(std::move(file), 4);
    ASSERT_EQ(journal.append(Time{9}, "PARTS", Bytes(67, 9)), Status::kOk);
    ASSERT_EQ(journal.flush(), Status::kOk);
    journal.begin_part();
    ASSERT_EQ(journal.append(Time{10}, "PARTS", Bytes(67, 10)), Status::kOk);
  }
  EXPECT_EQ(numbers(), (std::vector<std::uint32_t>{0, 1, 2, 3, 4, 5}));
  EXPECT_EQ(records().back().data, Bytes(67, 10));
}

TEST_F(JournalPartsTest, LeaveTheFirstMarkedAsWrittenWhereverTheJournalIsCut) {
  write(2, 1);
  JournalFile file(path_, ExistingJournal::kGoOn);
  file.cut(kRecordBytes);
  EXPECT_THROW(require_not_being_written(path_), FolderInUse);
  Journal journal(std::move(file), 1);
  journal.begin_part();
  ASSERT_EQ(journal.append(Time{9}, "PARTS", Bytes(67)), Status::kOk);
  ASSERT_EQ(journal.flush(), Status::kOk);
  EXPECT_TRUE(fs::exists(part(2)));
  EXPECT_THROW(require_not_being_written(path_), FolderInUse);
}

TEST_F(JournalPartsTest, AreNotBegunBeforeTheFirstRecordWhichNamesTheJournal) {
  Journal journal(path_);
  journal.begin_part();
  ASSERT_EQ(journal.append(Time{1}, "PARTS", Bytes(67)), Status::kOk);
  ASSERT_EQ(journal.close(), Status::kOk);
  EXPECT_EQ(fs::file_size(path_), kRecordBytes);
  EXPECT_FALSE(fs::exists(part(2)));
}

TEST_F(JournalPartsTest, ComeWhileTheyAreRead) {
  Journal journal(path_);
  ASSERT_EQ(journal.append(Time{1}, "PARTS", Bytes(67, 1)), Status::kOk);
  ASSERT_EQ(journal.flush(), Status::kOk);
  JournalReader reader(path_);
  JournalRecord record;
  ASSERT_TRUE(reader.next(record));
  EXPECT_FALSE(reader.next(record));
  ASSERT_EQ(journal.append(Time{2}, "PARTS", Bytes(67, 2)), Status::kOk);
  ASSERT_EQ(journal.flush(), Status::kOk);
  journal.begin_part();
  ASSERT_EQ(journal.append(Time{3}, "PARTS", Bytes(67, 3)), Status::kOk);
  ASSERT_EQ(journal.flush(), Status::kOk);
  reader.resume_reading();
  ASSERT_TRUE(reader.next(record));
  EXPECT_EQ(record.number, 1U);
  ASSERT_TRUE(reader.next(record));
  EXPECT_EQ(record.number, 2U);
  EXPECT_FALSE(reader.next(record));
  EXPECT_EQ(reader.end(), JournalReader::End::kWhole);
}

}  // namespace
}  // namespace earshot::host
