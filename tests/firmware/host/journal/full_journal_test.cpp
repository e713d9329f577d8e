// A journal on a disk that takes no more.

#include <gtest/gtest.h>

#include <unistd.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "firmware/host/file/folder_lock.hpp"
#include "firmware/host/journal/journal.hpp"
#include "firmware/host/journal/journal_reader.hpp"
#include "tests/support/file_size_limit.hpp"

namespace earshot::host {
namespace {

constexpr std::size_t kHeader_bytes = 28;  ///< journal.hpp prints it: 4 + 4 + 4 + 8 + 4 + 4

class FullJournal : public ::testing::Test {
 protected:
  FullJournal() {
    std::string name = (std::filesystem::temp_directory_path() / "earshot-full-XXXXXX").string();
    folder_ = ::mkdtemp(name.data());
    path_ = folder_ / "journal.lcmlog";
  }
  ~FullJournal() override { std::filesystem::remove_all(folder_); }

  /// A record that takes so many bytes of the file.
  [[nodiscard]] static Status append(Journal& journal, std::size_t bytes, Weight weight) {
    return journal.append(Time{0}, "A", std::vector<std::uint8_t>(bytes - kHeader_bytes - 1), weight);
  }

  [[nodiscard]] std::vector<std::uint32_t> numbers_in_file() const {
    JournalReader reader(path_);
    std::vector<std::uint32_t> numbers;
    for (JournalRecord record; reader.next(record);) numbers.push_back(record.number);
    EXPECT_EQ(reader.end(), JournalReader::End::kWhole);
    return numbers;
  }

  std::filesystem::path folder_;
  std::filesystem::path path_;
};

TEST_F(FullJournal, KeepsRoomForWhatSteersAndMoreForOrdersAndCountsEveryRecordThatIsLost) {
  Journal journal("/dev/full", {.existing = ExistingJournal::kReplace});
  // 6 MiB wait at most; 1 MiB of them is the orders' and 1 MiB the steering's, so that streams have 4 MiB: 4096 records of 1 KiB.
  for (int i = 0; i < 4096; ++i) ASSERT_EQ(append(journal, 1024, Weight::kStream), Status::kOk) << i;
  for (int i = 0; i < 3; ++i) EXPECT_EQ(append(journal, 1024, Weight::kStream), Status::kFull);
  for (int i = 0; i < 1024; ++i) ASSERT_EQ(append(journal, 1024, Weight::kSteering), Status::kOk) << i;
  for (int i = 0; i < 2; ++i) EXPECT_EQ(append(journal, 1024, Weight::kSteering), Status::kFull);
  for (int i = 0; i < 1024; ++i) ASSERT_EQ(append(journal, 1024, Weight::kOrder), Status::kOk) << i;
  EXPECT_EQ(append(journal, 1024, Weight::kOrder), Status::kFull);
  EXPECT_EQ(journal.counters().lost, (PerWeight{3, 2, 1}));
  EXPECT_EQ(journal.close(), Status::kNotReady);
  EXPECT_EQ(journal.counters().lost, (PerWeight{4099, 1026, 1025}));
  EXPECT_EQ(journal.counters().all_lost(), 6150U);
}

TEST_F(FullJournal, OnADiskThatStaysFullEndsWithAWholeRecordAndTheOthersAreCounted) {
  const support::FileSizeLimit disk(1050);
  Journal journal(path_);
  for (std::uint32_t i = 0; i < 30; ++i)
    ASSERT_EQ(append(journal, 100, i % 10 == 9 ? Weight::kOrder : i % 10 == 4 ? Weight::kSteering : Weight::kStream), Status::kOk);
  EXPECT_EQ(journal.close(), Status::kNotReady);
  EXPECT_EQ(std::filesystem::file_size(path_), 1000U);
  EXPECT_EQ(numbers_in_file(), (std::vector<std::uint32_t>{0, 1, 2, 3, 4, 5, 6, 7, 8, 9}));
  EXPECT_EQ(journal.counters().lost, (PerWeight{16, 2, 2}));  // of 20 records: 14 and 24 steered, 19 and 29 were orders
}

TEST_F(FullJournal, AtItsEndGivesTheRoomThatThereIsToTheHeaviestRecordsInTheOrderInWhichTheyCame) {
  const support::FileSizeLimit disk(1650);
  Journal journal(path_);
  for (int i = 0; i < 10; ++i) ASSERT_EQ(append(journal, 100, Weight::kStream), Status::kOk);
  ASSERT_EQ(append(journal, 1000, Weight::kStream), Status::kOk);  // 10: the disk takes 650 bytes of it
  for (int i = 0; i < 5; ++i) {
    ASSERT_EQ(append(journal, 100, Weight::kSteering), Status::kOk);  // 11, 14, 17, 20, 23
    ASSERT_EQ(append(journal, 100, Weight::kStream), Status::kOk);
    ASSERT_EQ(append(journal, 100, i < 3 ? Weight::kOrder : Weight::kStream), Status::kOk);  // 13, 16, 19
  }
  EXPECT_EQ(journal.close(), Status::kNotReady);
  // 650 bytes are room for all three orders and for the first three of those that steered.
  EXPECT_EQ(numbers_in_file(), (std::vector<std::uint32_t>{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 11, 13, 14, 16, 17, 19}));
  EXPECT_EQ(journal.counters().lost, (PerWeight{8, 2, 0}));
}

TEST_F(FullJournal, WritesEverythingThatWaitedOnceTheDiskHasRoomAgain) {
  Journal journal(path_);
  {
    const support::FileSizeLimit disk(1050);
    for (int i = 0; i < 50; ++i) ASSERT_EQ(append(journal, 100, Weight::kStream), Status::kOk);
    EXPECT_EQ(journal.flush(), Status::kNotReady);
  }
  EXPECT_EQ(journal.close(), Status::kOk);
  EXPECT_EQ(numbers_in_file().size(), 50U);
  EXPECT_EQ(journal.counters().all_lost(), 0U);
}

TEST_F(FullJournal, IsNotReplacedByAnotherWhileItIsWritten) {
  Journal first(path_);
  ASSERT_EQ(append(first, 100, Weight::kStream), Status::kOk);
  try {
    const Journal second(path_, {.existing = ExistingJournal::kReplace});
    ADD_FAILURE() << "two write one file";
  } catch (const FolderInUse& e) {
    EXPECT_EQ(std::string(e.what()),
              path_.string() + ": full_journal_te (process " + std::to_string(::getpid()) + ") is writing this file");
  }
  EXPECT_EQ(first.close(), Status::kOk);
  EXPECT_EQ(numbers_in_file().size(), 1U);
  const Journal third(path_, {.existing = ExistingJournal::kReplace});
}

}  // namespace
}  // namespace earshot::host
