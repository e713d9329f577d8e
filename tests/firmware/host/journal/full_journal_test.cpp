// A journal on a disk that takes no more.

#include <gtest/gtest.h>

#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <string>
#include <thread>
#include <vector>

#include "firmware/host/file/folder_lock.hpp"
#include "firmware/host/journal/journal.hpp"
#include "firmware/host/journal/journal_reader.hpp"
#include "firmware/wire/journal/closing_record.hpp"
#include "tests/support/file_size_limit.hpp"
#include "tests/support/temporary_folder.hpp"

namespace earshot::host {
namespace {

constexpr std::size_t kHeader_bytes = 28;  ///< journal.hpp prints it: 4 + 4 + 4 + 8 + 4 + 4

class FullJournal : public ::testing::Test {
 protected:
  /// A record that takes so many bytes of the file.
  [[nodiscard]] static Status append(Journal& journal, std::size_t bytes, Priority priority) {
    return journal.append(Time{0}, "A", std::vector<std::uint8_t>(bytes - kHeader_bytes - 1), priority);
  }

  [[nodiscard]] std::vector<std::uint32_t> numbers_in_file() const {
    JournalReader reader(path_);
    std::vector<std::uint32_t> numbers = numbers_in(reader);
    EXPECT_EQ(reader.end(), JournalReader::End::kWhole);
    return numbers;
  }

  [[nodiscard]] static std::vector<std::uint32_t> numbers_in(JournalReader& reader) {
    std::vector<std::uint32_t> numbers;
    for (JournalRecord record; reader.next(record);) numbers.push_back(record.number);
    return numbers;
  }

  /// The last record in the file.
  [[nodiscard]] messages::ClosingRecord closing_record() const {
    JournalReader reader(path_);
    JournalRecord record;
    while (reader.next(record)) {
    }
    EXPECT_EQ(record.channel, "EARSHOT_JOURNAL_END");
    messages::ClosingRecord closing;
    EXPECT_EQ(wire::read_closing_record(record.data, closing), Status::kOk);
    return closing;
  }

  const support::TemporaryFolder folder_;
  const std::filesystem::path path_ = folder_ / "journal.lcmlog";
};

TEST_F(FullJournal, KeepsRoomForWhatSteersAndMoreForOrdersAndCountsEveryRecordThatIsLost) {
  Journal journal("/dev/full", {.existing = ExistingJournal::kReplace});
  // 6 MiB wait at most; 1 MiB of them is the orders' and 1 MiB the steering's, so that streams have 4 MiB: 4096 records of 1 KiB.
  for (int i = 0; i < 4096; ++i) ASSERT_EQ(append(journal, 1024, Priority::kStream), Status::kOk) << i;
  for (int i = 0; i < 3; ++i) EXPECT_EQ(append(journal, 1024, Priority::kStream), Status::kFull);
  for (int i = 0; i < 1024; ++i) ASSERT_EQ(append(journal, 1024, Priority::kSteering), Status::kOk) << i;
  for (int i = 0; i < 2; ++i) EXPECT_EQ(append(journal, 1024, Priority::kSteering), Status::kFull);
  for (int i = 0; i < 1024; ++i) ASSERT_EQ(append(journal, 1024, Priority::kOrder), Status::kOk) << i;
  EXPECT_EQ(append(journal, 1024, Priority::kOrder), Status::kFull);
  EXPECT_EQ(journal.counters().lost, (PerPriority{3, 2, 1}));
  EXPECT_EQ(journal.close(), Status::kNotReady);
  EXPECT_EQ(journal.counters().lost, (PerPriority{4099, 1026, 1025}));
  EXPECT_EQ(journal.counters().all_lost(), 6150U);
}

TEST_F(FullJournal, OnADiskTooSmallForAReserveEndsWithAWholeRecordAndTheOthersAreCounted) {
  const support::FileSizeLimit disk(1050);
  Journal journal(path_);
  for (std::uint32_t i = 0; i < 30; ++i)
    ASSERT_EQ(append(journal, 100, i % 10 == 9 ? Priority::kOrder : i % 10 == 4 ? Priority::kSteering : Priority::kStream), Status::kOk);
  EXPECT_EQ(journal.close(), Status::kNotReady);
  EXPECT_EQ(std::filesystem::file_size(path_), 1000U);
  // Three orders, three that steered, and of 24 streams the first four.
  EXPECT_EQ(numbers_in_file(), (std::vector<std::uint32_t>{0, 1, 2, 3, 4, 9, 14, 19, 24, 29}));
  EXPECT_EQ(journal.counters().lost, (PerPriority{20, 0, 0}));
}

TEST_F(FullJournal, AtItsEndGivesTheRoomThatThereIsToTheHeaviestRecordsInTheOrderInWhichTheyCame) {
  const support::FileSizeLimit disk(1650);
  Journal journal(path_);
  for (int i = 0; i < 10; ++i) ASSERT_EQ(append(journal, 100, Priority::kStream), Status::kOk);
  ASSERT_EQ(append(journal, 1000, Priority::kStream), Status::kOk);  // 10: the disk takes 650 bytes of it
  for (int i = 0; i < 5; ++i) {
    ASSERT_EQ(append(journal, 100, Priority::kSteering), Status::kOk);  // 11, 14, 17, 20, 23
    ASSERT_EQ(append(journal, 100, Priority::kStream), Status::kOk);
    ASSERT_EQ(append(journal, 100, i < 3 ? Priority::kOrder : Priority::kStream), Status::kOk);  // 13, 16, 19
  }
  EXPECT_EQ(journal.close(), Status::kNotReady);
  // Three orders and five that steered leave 850 bytes for streams.
  EXPECT_EQ(numbers_in_file(), (std::vector<std::uint32_t>{0, 1, 2, 3, 4, 5, 6, 7, 11, 13, 14, 16, 17, 19, 20, 23}));
  EXPECT_EQ(journal.counters().lost, (PerPriority{10, 0, 0}));
}

TEST_F(FullJournal, ThatWasConcludedEndsWithItsClosingRecordWhichCountsWhatIsMissing) {
  const support::FileSizeLimit disk(1050);
  Journal journal(path_);
  for (std::uint32_t i = 0; i < 30; ++i)
    ASSERT_EQ(append(journal, 100, i % 10 == 9 ? Priority::kOrder : i % 10 == 4 ? Priority::kSteering : Priority::kStream), Status::kOk);
  messages::ClosingRecord said{.time = Time{5}, .state = messages::MissionState::kAbort, .steps_taken = 3};
  journal.conclude(said);
  EXPECT_EQ(journal.close(), Status::kNotReady);
  // 28 + 19 + 47 bytes are the closing record's: a stream less than without it.
  EXPECT_EQ(std::filesystem::file_size(path_), 994U);
  EXPECT_EQ(numbers_in_file(), (std::vector<std::uint32_t>{0, 1, 2, 4, 9, 14, 19, 24, 29, 30}));
  EXPECT_EQ(journal.counters().lost, (PerPriority{21, 0, 0}));
  said.lost.streams = 21;
  EXPECT_EQ(closing_record(), said);
}

TEST_F(FullJournal, OfADiskThatWasNeverFullEndsWithAClosingRecordThatCountsNothing) {
  Journal journal(path_);
  ASSERT_EQ(append(journal, 100, Priority::kStream), Status::kOk);
  const messages::ClosingRecord said{.time = Time{5}, .ending = messages::Ending::kMissionOver};
  journal.conclude(said);
  EXPECT_EQ(journal.close(), Status::kOk);
  EXPECT_EQ(numbers_in_file(), (std::vector<std::uint32_t>{0, 1}));
  EXPECT_EQ(closing_record(), said);
}

/// GIVEN a disk of which a journal holds three pieces of 64 KiB when it is full: its streams have two of them, the third is the reserve.
class JournalReserve : public FullJournal {
 protected:
  void fill(Journal& journal) {
    for (int i = 0; i < 200; ++i) ASSERT_EQ(append(journal, 1024, Priority::kStream), Status::kOk);
    ASSERT_EQ(journal.flush(), Status::kNotReady);
    ASSERT_EQ(std::filesystem::file_size(path_), 131'072U);
  }

  /// Waits for what the writer does within a tenth of a second.
  [[nodiscard]] bool is_in_file(std::uint32_t number) const {
    for (int i = 0; i < 500; ++i) {
      JournalReader reader(path_);  // while it is written
      const std::vector<std::uint32_t> numbers = numbers_in(reader);
      if (std::ranges::find(numbers, number) != numbers.end()) return true;
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return false;
  }

  const support::FileSizeLimit disk_{196'608};
};

TEST_F(JournalReserve, TakesAnOrderAndWhatSteeredBeforeItAtOnceThoughTheDiskIsFull) {
  Journal journal(path_);
  fill(journal);
  ASSERT_EQ(append(journal, 1024, Priority::kSteering), Status::kOk);  // 200
  ASSERT_EQ(append(journal, 1024, Priority::kStream), Status::kOk);
  ASSERT_EQ(append(journal, 1024, Priority::kOrder), Status::kOk);  // 202
  EXPECT_TRUE(is_in_file(202)) << "a crash would lose it";
  EXPECT_TRUE(is_in_file(200));
  EXPECT_EQ(numbers_in_file().size(), 130U);
  EXPECT_EQ(journal.close(), Status::kOk) << "nothing waited any longer";
  EXPECT_EQ(journal.counters().lost, (PerPriority{73, 0, 0})) << "of 201 streams 128 are in the file";
  EXPECT_EQ(numbers_in_file().size(), 130U);
}

TEST_F(JournalReserve, KeepsHalfOfItselfFromWhatSteersForOrdersToComeAndForTheEnd) {
  Journal journal(path_);
  fill(journal);
  for (int i = 0; i < 100; ++i) ASSERT_EQ(append(journal, 1024, Priority::kSteering), Status::kOk);  // 200 to 299
  ASSERT_EQ(append(journal, 1024, Priority::kOrder), Status::kOk);
  ASSERT_TRUE(is_in_file(300));
  EXPECT_EQ(numbers_in_file().size(), 128U + 31U + 1U) << "32 KiB but for the order";
  for (int i = 0; i < 31; ++i) ASSERT_EQ(append(journal, 1024, Priority::kOrder), Status::kOk);
  ASSERT_TRUE(is_in_file(331));
  for (int i = 0; i < 5; ++i) ASSERT_EQ(append(journal, 1024, Priority::kOrder), Status::kOk);
  journal.conclude({});
  EXPECT_EQ(journal.close(), Status::kNotReady) << "the reserve is used up but for the closing record";
  EXPECT_EQ(closing_record().lost, (messages::LostRecords{.streams = 72, .steering = 69, .orders = 5}));
}

TEST_F(FullJournal, LetsGoOfTheSpaceItHeldWhenItIsClosed) {
  Journal journal(path_);
  ASSERT_EQ(append(journal, 100, Priority::kStream), Status::kOk);
  EXPECT_EQ(journal.close(), Status::kOk);
  struct stat status {};
  ASSERT_EQ(::stat(path_.c_str(), &status), 0);
  EXPECT_LT(status.st_blocks, 65'536 / 512) << "blocks of 512 bytes";
}

TEST_F(FullJournal, WritesEverythingThatWaitedOnceTheDiskHasRoomAgain) {
  Journal journal(path_);
  {
    const support::FileSizeLimit disk(1050);
    for (int i = 0; i < 50; ++i) ASSERT_EQ(append(journal, 100, Priority::kStream), Status::kOk);
    EXPECT_EQ(journal.flush(), Status::kNotReady);
  }
  EXPECT_EQ(journal.close(), Status::kOk);
  EXPECT_EQ(numbers_in_file().size(), 50U);
  EXPECT_EQ(journal.counters().all_lost(), 0U);
}

TEST_F(FullJournal, IsNotReplacedByAnotherWhileItIsWritten) {
  Journal first(path_);
  ASSERT_EQ(append(first, 100, Priority::kStream), Status::kOk);
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
