#include "firmware/host/file/folder_lock.hpp"

#include <gtest/gtest.h>

#include <fcntl.h>
#include <unistd.h>

#include <sys/wait.h>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <system_error>

#include "tests/firmware/host/file/killed_holder.hpp"
#include "tests/support/temporary_folder.hpp"

namespace earshot::host {
namespace {

namespace fs = std::filesystem;

class FolderLock : public testing::Test {
 protected:
  const support::TemporaryFolder folder_;
};

TEST_F(FolderLock, RefusesASecondWriterAndNamesTheFirst) {
  const FileDescriptor first = lock_folder(folder_);
  try {
    const FileDescriptor second = lock_folder(folder_);
    FAIL() << "two hold the lock";
  } catch (const FolderInUse& e) {
    EXPECT_EQ(std::string(e.what()),
              folder_.path().string() + ": host_file_test (process " + std::to_string(::getpid()) + ") is writing into this folder");
  }
}

TEST_F(FolderLock, IsOneFolderByWhateverPath) {
  const FileDescriptor first = lock_folder(folder_);
  fs::create_directory(folder_ / "inner");
  EXPECT_THROW((void)lock_folder(folder_ / "inner" / ".."), FolderInUse);
}

TEST_F(FolderLock, IsFreeAgainWhenItsHolderIsKilledAndLeavesNothingBehind) {
  int held[2];
  ASSERT_EQ(::pipe(held), 0);
  const pid_t holder = ::fork();
  if (holder == 0) {
    const FileDescriptor lock = lock_folder(folder_);
    if (::write(held[1], "!", 1) == 1) ::pause();
    std::_Exit(1);
  }
  char word = 0;
  ASSERT_EQ(::read(held[0], &word, 1), 1);
  EXPECT_THROW((void)lock_folder(folder_), FolderInUse);
  ::kill(holder, SIGKILL);
  ::waitpid(holder, nullptr, 0);
  EXPECT_NO_THROW((void)lock_folder(folder_));
  EXPECT_TRUE(fs::is_empty(folder_));
}

TEST_F(FolderLock, NamesAFolderThatIsNotThere) {
  try {
    (void)lock_folder(folder_ / "none");
    FAIL() << "a folder that is not there is locked";
  } catch (const std::system_error& e) {
    EXPECT_NE(std::string(e.what()).find((folder_ / "none").string()), std::string::npos) << e.what();
    EXPECT_EQ(e.code(), std::errc::no_such_file_or_directory);
  }
}

TEST_F(FolderLock, TellsAFileThatIsBeingWrittenFromOneThatIsNot) {
  const fs::path path = folder_ / "journal";
  const FileDescriptor writer(::open(path.c_str(), O_CREAT | O_RDWR | O_CLOEXEC, 0600));
  EXPECT_NO_THROW(require_not_being_written(path));
  mark_as_written(writer, path);
  try {
    require_not_being_written(path);
    FAIL() << "a file is read while it is written";
  } catch (const FolderInUse& e) {
    EXPECT_EQ(std::string(e.what()), path.string() + ": host_file_test (process " + std::to_string(::getpid()) + ") is writing this file");
  }
}

/// Without standard input the next file that is opened is descriptor 0, a good one.
TEST_F(FolderLock, TellsAFileThatIsBeingWrittenWhereStandardInputIsClosed) {
  const fs::path path = folder_ / "journal";
  const FileDescriptor writer(::open(path.c_str(), O_CREAT | O_RDWR | O_CLOEXEC, 0600));
  mark_as_written(writer, path);
  const pid_t reader = ::fork();
  if (reader == 0) {
    ::close(STDIN_FILENO);
    try {
      require_not_being_written(path);
      std::_Exit(0);
    } catch (const FolderInUse&) {
      std::_Exit(3);
    }
  }
  int status = 0;
  ASSERT_EQ(::waitpid(reader, &status, 0), reader);
  EXPECT_EQ(WEXITSTATUS(status), 3) << "it is read while it is written";
}

TEST_F(FolderLock, OfAProcessThatWasKilledIsKnownAsSuchWhileItIsHeld) {
  const fs::path path = folder_ / "record";
  const support::KilledHolder holder(path, "host_file_test");
  const FileDescriptor file(::open(path.c_str(), O_RDWR | O_CLOEXEC));
  EXPECT_EQ(marked_by(file), MarkedBy::kTheKilled);
}

TEST_F(FolderLock, OfAnotherProgramIsKnownAsSuchThoughItWasKilled) {
  const fs::path path = folder_ / "record";
  const support::KilledHolder backup(path, "backup");
  const FileDescriptor file(::open(path.c_str(), O_RDWR | O_CLOEXEC));
  EXPECT_EQ(marked_by(file), MarkedBy::kAnotherProgram);
}

TEST_F(FolderLock, OfThisProgramIsKnownAsSuch) {
  const fs::path path = folder_ / "record";
  const FileDescriptor first(::open(path.c_str(), O_CREAT | O_RDWR | O_CLOEXEC, 0600));
  mark_as_written(first, path);
  const FileDescriptor second(::open(path.c_str(), O_RDWR | O_CLOEXEC));
  EXPECT_EQ(marked_by(second), MarkedBy::kThisProgram);
}

}  // namespace
}  // namespace earshot::host
