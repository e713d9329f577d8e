// A disk that does not answer: fdatasync(2) of this program waits until the test lets it go on.

#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <semaphore>

#include "tests/firmware/host/journal/journal_folder.hpp"
#include "tests/support/file_size_limit.hpp"

namespace {

std::counting_semaphore<1000> disk_answers(0);
std::atomic<off_t> bytes_on_disk = 0;  ///< of the file that was brought there last

}  // namespace

extern "C" int fdatasync(int file) {
  disk_answers.acquire();
  struct stat status {};
  if (::fstat(file, &status) == 0) bytes_on_disk = status.st_size;
  return static_cast<int>(::syscall(SYS_fdatasync, file));
}

namespace earshot::host {
namespace {

using namespace std::chrono_literals;
using Reach = Journal::Reach;

using JournalReach = JournalFolder;

TEST_F(JournalReach, OfTheFileDoesNotWaitForTheDiskAndThatOfTheDiskDoes) {
  Journal journal(path_, {.when_full = JournalOptions::WhenFull::kDrop, .survives = JournalOptions::Survives::kPowerCut});
  const Bytes data(100);
  ASSERT_EQ(journal.append(Time{1}, "STREAM", data), Status::kOk);
  EXPECT_EQ(journal.flush(20s, Reach::kFile), Status::kOk) << "it is in the file";
  EXPECT_EQ(journal.flush(10ms, Reach::kDisk), Status::kNotReady) << "and on its way to the disk";
  EXPECT_EQ(journal.flush(10ms), Status::kNotReady) << "which is what is meant unless told";
  ASSERT_EQ(journal.append(Time{2}, "STREAM", data), Status::kOk);
  EXPECT_EQ(journal.flush(10ms, Reach::kFile), Status::kNotReady) << "the writer waits for the disk";
  disk_answers.release(500);
  EXPECT_EQ(journal.flush(20s, Reach::kDisk), Status::kOk);
  EXPECT_EQ(journal.flush(20s, Reach::kFile), Status::kOk);
}

TEST_F(JournalReach, OfAJournalThatIsClosedWithoutAClosingRecordIsTheDiskForItsLastRecordsToo) {
  disk_answers.release(10);
  bytes_on_disk = 0;
  const support::FileSizeLimit disk(1050);  // too small for a reserve: the writer leaves all of them to the end
  Journal journal(path_, {.when_full = JournalOptions::WhenFull::kDrop, .survives = JournalOptions::Survives::kPowerCut});
  for (int i = 0; i < 30; ++i) ASSERT_EQ(journal.append(Time{1}, "A", Bytes(71)), Status::kOk);
  ASSERT_EQ(journal.flush(), Status::kNotReady);
  EXPECT_EQ(journal.close(), Status::kNotReady);
  EXPECT_EQ(std::filesystem::file_size(path_), 1000U) << "of 100 bytes each";
  EXPECT_GE(bytes_on_disk, 1000) << "when it was brought there for the last time";
}

}  // namespace
}  // namespace earshot::host
