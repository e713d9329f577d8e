// A disk that does not answer: fdatasync(2) of this program waits until the test lets it go on.

#include <sys/syscall.h>
#include <unistd.h>

#include <chrono>
#include <semaphore>

#include "tests/firmware/host/journal/journal_folder.hpp"

namespace {

std::counting_semaphore<1000> disk_answers(0);

}  // namespace

extern "C" int fdatasync(int file) {
  disk_answers.acquire();
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

}  // namespace
}  // namespace earshot::host
