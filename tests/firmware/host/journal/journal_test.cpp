#include "firmware/host/journal/journal.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <lcm/lcm-cpp.hpp>
#include <span>
#include <string>
#include <system_error>
#include <thread>
#include <vector>

#include "firmware/config/capacities.hpp"
#include "firmware/core/crc32.hpp"
#include "firmware/host/file/bad_input.hpp"
#include "firmware/host/file/file_descriptor.hpp"
#include "firmware/host/journal/journal_format.hpp"
#include "firmware/host/journal/journal_reader.hpp"
#include "tests/firmware/host/journal/journal_folder.hpp"

namespace earshot::host {
namespace {

class JournalTest : public JournalFolder {};

TEST_F(JournalTest, WritesARecordByteForByteAsItsHeaderPrintsIt) {
  {
    Journal journal(path_);
    ASSERT_EQ(journal.append(Time{0x0102030405060708}, "AB", Bytes{9, 8, 7}), Status::kOk);
  }
  const Bytes bytes = contents();
  ASSERT_EQ(bytes.size(), 33U);
  const Bytes checked(bytes.begin() + 8, bytes.end());
  EXPECT_EQ(checked, (Bytes{0, 0, 0, 0, 1, 2, 3, 4, 5, 6, 7, 8, 0, 0, 0, 2, 0, 0, 0, 3, 'A', 'B', 9, 8, 7}));
  // Sync word, then zlib.crc32 of `checked` from Python 3.11.
  EXPECT_EQ(Bytes(bytes.begin(), bytes.begin() + 8), (Bytes{0xED, 0xA1, 0xDA, 0x01, 0x94, 0xC1, 0x59, 0x8E}));
}

TEST_F(JournalTest, ReadsBackWhatWasAppendedInOrder) {
  write_three_records();
  JournalReader reader(path_);
  JournalRecord record;
  ASSERT_TRUE(reader.next(record));
  EXPECT_EQ(record.number, 0U);
  EXPECT_EQ(record.time, Time{1});
  EXPECT_EQ(record.channel, "A");
  EXPECT_EQ(record.data, (Bytes{1, 2, 3}));
  ASSERT_TRUE(reader.next(record));
  EXPECT_TRUE(record.data.empty());
  ASSERT_TRUE(reader.next(record));
  EXPECT_EQ(record.number, 2U);
  EXPECT_EQ(record.data, Bytes(40, 0x55));
  EXPECT_FALSE(reader.next(record));
  EXPECT_EQ(reader.end(), JournalReader::End::kWhole);
}

TEST_F(JournalTest, IsAnEventLogToLiblcm) {
  write_three_records();
  lcm::LogFile log(path_.string(), "r");
  ASSERT_TRUE(log.good());
  const std::vector<std::string> channels{"A", "BB", "CCC"};
  const std::vector<int> sizes{3, 0, 40};
  for (std::size_t i = 0; i < 3; ++i) {
    const lcm::LogEvent* event = log.readNextEvent();
    ASSERT_NE(event, nullptr) << i;
    EXPECT_EQ(event->channel, channels[i]);
    EXPECT_EQ(event->timestamp, static_cast<std::int64_t>(i) + 1);
    EXPECT_EQ(event->datalen, sizes[i]);
  }
  EXPECT_EQ(log.readNextEvent(), nullptr);
}

TEST_F(JournalTest, ReadsOnWhereItsNumbersBeginAnew) {
  write_three_records();
  Bytes bytes = contents();
  const std::size_t sizes[] = {28 + 1 + 3, 28 + 2, 28 + 3 + 40};
  std::uint32_t number = 0xFFFFFFFE;
  auto rest = std::span(bytes);
  for (const std::size_t size : sizes) {
    store_big_endian(rest.subspan(8, 4), number++);
    store_big_endian(rest.subspan(4, 4), crc32(rest.subspan(8, size - 8)));
    rest = rest.subspan(size);
  }
  overwrite(bytes);
  JournalReader reader(path_);
  JournalRecord record;
  for (const std::uint32_t expected : {0xFFFFFFFEU, 0xFFFFFFFFU, 0U}) {
    ASSERT_TRUE(reader.next(record));
    EXPECT_EQ(record.number, expected);
  }
  EXPECT_FALSE(reader.next(record));
  EXPECT_EQ(reader.end(), JournalReader::End::kWhole);
}

TEST_F(JournalTest, SaysAtWhichByteItIsCut) {
  write_three_records();
  Bytes bytes = contents();
  bytes.pop_back();
  overwrite(bytes);
  JournalReader reader(path_);
  JournalRecord record;
  while (reader.next(record)) {
  }
  EXPECT_EQ(reader.offset(), 28U + 1 + 3 + 28 + 2);
}

TEST_F(JournalTest, LosesNothingOfManyTimesItsBufferWhenItMayWait) {
  const std::size_t count = 3 * config::kJournalBufferBytes / 1000;
  Journal journal(path_, {.when_full = JournalOptions::WhenFull::kWait});
  for (std::size_t i = 0; i < count; ++i)
    ASSERT_EQ(journal.append(Time{static_cast<std::int64_t>(i)}, "CHANNEL", Bytes(1000, static_cast<std::uint8_t>(i))), Status::kOk);
  ASSERT_EQ(journal.flush(), Status::kOk);
  JournalReader reader(path_);
  JournalRecord record;
  std::size_t read = 0;
  for (; reader.next(record); ++read) ASSERT_EQ(record.data, Bytes(1000, static_cast<std::uint8_t>(read)));
  EXPECT_EQ(read, count);
  EXPECT_EQ(journal.counters().all_lost(), 0U);
}

/// How often all threads of this process but the calling one have gone to sleep.
std::uint64_t sleeps_of_other_threads() {
  std::uint64_t sleeps = 0;
  for (const auto& task : std::filesystem::directory_iterator("/proc/self/task")) {
    if (task.path().filename() == std::to_string(::gettid())) continue;
    std::ifstream status(task.path() / "status");
    for (std::string line; std::getline(status, line);) {
      if (line.starts_with("voluntary_ctxt_switches:")) sleeps += std::stoull(line.substr(line.find(':') + 1));
    }
  }
  return sleeps;
}

TEST_F(JournalTest, LeavesItsWriterAloneInThePauseBetweenTwoWrites) {
  using std::chrono::steady_clock;
  Journal journal(path_);
  const std::uint64_t before = sleeps_of_other_threads();
  const auto began = steady_clock::now();
  for (int i = 0; i < 2000; ++i) {
    ASSERT_EQ(journal.append(Time{1}, "A", Bytes(16, 1)), Status::kOk);
    std::this_thread::sleep_for(std::chrono::microseconds(50));
  }
  // Two sleeps a write: for the pause of a millisecond and, if nothing has come meanwhile, for the next record; one more for the lock.
  const auto pauses = static_cast<std::uint64_t>((steady_clock::now() - began) / std::chrono::milliseconds(1));
  EXPECT_LE(sleeps_of_other_threads() - before, 3 * (pauses + 10));
}

TEST_F(JournalTest, DropsAndCountsInsteadOfWaitingForADiskThatHangs) {
  // A pipe that nobody reads is a disk that hangs after 64 KiB.
  ASSERT_EQ(::mkfifo(path_.c_str(), 0600), 0);
  FileDescriptor reader(::open(path_.c_str(), O_RDONLY | O_NONBLOCK));
  auto journal = std::make_unique<Journal>(path_, JournalOptions{.existing = ExistingJournal::kReplace});
  const Bytes data(100'000);
  std::size_t taken = 0;
  while (journal->append(Time{0}, "CHANNEL", data) == Status::kOk) ++taken;
  EXPECT_GE(taken, RecordRing::limit(Priority::kStream) / (data.size() + 64));
  EXPECT_EQ(journal->counters().appended, taken);
  EXPECT_EQ(journal->counters().all_lost(), 1U);
  ::signal(SIGPIPE, SIG_IGN);
  reader = FileDescriptor();  // the writer's hanging write fails now, and close() can end
}

TEST_F(JournalTest, ReportsADiskThatIsFull) {
  Journal journal("/dev/full", {.when_full = JournalOptions::WhenFull::kWait, .existing = ExistingJournal::kReplace});
  ASSERT_EQ(journal.append(Time{0}, "CHANNEL", Bytes(10)), Status::kOk);
  EXPECT_EQ(journal.flush(), Status::kNotReady);
  while (journal.append(Time{0}, "CHANNEL", Bytes(100'000)) == Status::kOk) {
  }
  EXPECT_GE(journal.counters().write_errors, 1U);
  EXPECT_EQ(journal.counters().all_lost(), 1U);
  EXPECT_EQ(journal.close(), Status::kNotReady);
}

TEST_F(JournalTest, SaysThatWhatItWroteDidNotReachTheDisk) {
  // /dev/null takes every byte, and fdatasync(2) of it fails: it is no file on a disk.
  Journal journal("/dev/null", {.survives = JournalOptions::Survives::kPowerCut, .existing = ExistingJournal::kReplace});
  ASSERT_EQ(journal.append(Time{0}, "CHANNEL", Bytes(10)), Status::kOk);
  EXPECT_EQ(journal.close(), Status::kNotReady);
  EXPECT_EQ(journal.counters().write_errors, 1U);
}

TEST_F(JournalTest, OfAProcessKilledInMidFlightReadsBackWhole) {
  const ::pid_t child = ::fork();
  if (child == 0) {
    Journal journal(path_);
    for (std::int64_t i = 0; i < 1000; ++i) static_cast<void>(journal.append(Time{i}, "CHANNEL", Bytes(60, 7)));
    static_cast<void>(journal.flush());
    for (std::int64_t i = 1000;; ++i) static_cast<void>(journal.append(Time{i}, "CHANNEL", Bytes(60, 7)));
  }
  while (!std::filesystem::exists(path_) || std::filesystem::file_size(path_) < 200'000) ::usleep(1000);
  ::kill(child, SIGKILL);
  ::waitpid(child, nullptr, 0);
  JournalReader reader(path_);
  JournalRecord record;
  std::size_t count = 0;
  while (reader.next(record)) ++count;
  EXPECT_NE(reader.end(), JournalReader::End::kCorrupt);
  EXPECT_GE(count, 1000U);
}

TEST_F(JournalTest, NamesAFolderThatIsNoJournal) {
  try {
    const JournalReader reader(folder_);
    FAIL();
  } catch (const host::BadInput& error) {
    EXPECT_EQ(error.what(), folder_.path().string() + ": cannot be read: it is a folder");
  }
}

TEST_F(JournalTest, ReadsAJournalOfManyPiecesInOneMebibyteOfMemory) {
  constexpr std::size_t kRecord = 28 + 5 + 60'000;
  {
    Journal journal(path_);
    for (std::int64_t i = 0; i < 100; ++i) {
      ASSERT_EQ(journal.append(Time{i}, "LARGE", Bytes(60'000, static_cast<std::uint8_t>(i))), Status::kOk);
      ASSERT_EQ(journal.flush(), Status::kOk);
    }
  }
  JournalReader reader(path_);
  EXPECT_EQ(reader.file_size(), 100 * kRecord);
  std::size_t count = 0;
  for (JournalRecord record; reader.next(record); ++count) {
    ASSERT_EQ(record.data, Bytes(60'000, static_cast<std::uint8_t>(count))) << count;
    ASSERT_EQ(reader.offset(), (count + 1) * kRecord);
  }
  EXPECT_EQ(count, 100U);
  EXPECT_EQ(reader.end(), JournalReader::End::kWhole);
}

TEST_F(JournalTest, TakesNoMemoryForAFileOfHolesAndNamesItsFirstByte) {
  std::ofstream(path_).close();
  std::filesystem::resize_file(path_, std::uintmax_t{1} << 40U);  // 1 TiB: who reads it into memory has none left
  JournalReader reader(path_);
  JournalRecord record;
  EXPECT_FALSE(reader.next(record));
  EXPECT_EQ(reader.end(), JournalReader::End::kCorrupt);
  EXPECT_EQ(reader.offset(), 0U);
}

TEST_F(JournalTest, DoesNotOverwriteUnlessTold) {
  write_three_records();
  EXPECT_THROW(Journal{path_}, std::system_error);
  EXPECT_EQ(records_until(JournalReader::End::kWhole), 3U);
}

TEST_F(JournalTest, StartedAgainKeepsTheJournalsThatAreThere) {
  const JournalOptions at_sea{.survives = JournalOptions::Survives::kPowerCut, .existing = ExistingJournal::kKeep};
  write_three_records();
  const Bytes first = contents();
  EXPECT_EQ(Journal(path_, at_sea).path(), folder_ / "journal-2.lcmlog");
  EXPECT_EQ(Journal(path_, at_sea).path(), folder_ / "journal-3.lcmlog");
  EXPECT_EQ(contents(), first);
}

TEST_F(JournalTest, TakesARecordOnTheLongestChannelThatReadersTake) {
  Journal journal(path_, {.existing = ExistingJournal::kReplace});
  EXPECT_EQ(journal.append(Time{1}, std::string(63, 'C'), Bytes{1}), Status::kOk);
  EXPECT_EQ(journal.append(Time{2}, std::string(64, 'C'), Bytes{1}), Status::kOutOfRange);
  EXPECT_EQ(journal.close(), Status::kOk);
  EXPECT_EQ(records_until(JournalReader::End::kWhole), 1U);
}

TEST_F(JournalTest, ThatSurvivesAPowerCutFailsAtNothingOnAHealthyDisk) {
  Journal journal(path_, {.survives = JournalOptions::Survives::kPowerCut, .existing = ExistingJournal::kReplace});
  EXPECT_EQ(journal.append(Time{1}, "A", Bytes{1}), Status::kOk);
  EXPECT_EQ(journal.close(), Status::kOk);
  EXPECT_EQ(records_until(JournalReader::End::kWhole), 1U);
}

TEST_F(JournalTest, RefusesRecordsThatReadersWouldNotTake) {
  Journal journal(path_);
  EXPECT_EQ(journal.append(Time{0}, "", Bytes{}), Status::kOutOfRange);
  EXPECT_EQ(journal.append(Time{0}, std::string(64, 'A'), Bytes{}), Status::kOutOfRange);
  EXPECT_EQ(journal.append(Time{0}, "A", Bytes(config::kLcmMessageBytes + 1)), Status::kOutOfRange);
  EXPECT_EQ(journal.counters().refused, 3U);
}

}  // namespace
}  // namespace earshot::host
