// A disk that writes little at a time, is interrupted, fails, or cannot make files without a name: the calls of this program go by here.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdarg>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <system_error>
#include <vector>

#include "firmware/host/file/bad_input.hpp"
#include "firmware/host/file/folder_lock.hpp"
#include "firmware/host/file/input_file.hpp"
#include "firmware/host/file/output_file.hpp"
#include "tests/support/temporary_folder.hpp"

namespace {

/// What the disk does from now on; 0: nothing unusual.
struct Sickness {
  std::size_t most_at_once = 0;  ///< bytes that are written or read
  int interruptions = 0;         ///< so many calls of write and read are interrupted first
  int write_error = 0;
  int read_error = 0;
  int open_error = 0;  ///< of files that are read
  int content_sync_error = 0;
  int folder_sync_error = 0;
  int lock_error = 0;
  bool knows_files_without_name = true;
};
Sickness sickness;
std::vector<std::string> synced;  ///< "content" or "folder", in order

bool is_interrupted() {
  if (sickness.interruptions == 0) return false;
  --sickness.interruptions;
  errno = EINTR;
  return true;
}

/// What succeeds leaves errno as it was, as the kernel does.
bool fails(int error) {
  if (error != 0) errno = error;
  return error != 0;
}

std::size_t at_once(std::size_t size) {
  return sickness.most_at_once > 0 && size > sickness.most_at_once ? sickness.most_at_once : size;
}

}  // namespace

extern "C" {

ssize_t write(int file, const void* bytes, size_t size) {
  if (is_interrupted() || fails(sickness.write_error)) return -1;
  return syscall(SYS_write, file, bytes, at_once(size));
}

ssize_t read(int file, void* bytes, size_t size) {
  if (is_interrupted() || fails(sickness.read_error)) return -1;
  return syscall(SYS_read, file, bytes, at_once(size));
}

int open(const char* path, int flags, ...) {
  std::va_list rest;
  va_start(rest, flags);
  const int mode = va_arg(rest, int);
  va_end(rest);
  const bool has_no_name = (flags & O_TMPFILE) == O_TMPFILE;
  if (has_no_name && !sickness.knows_files_without_name) return fails(EOPNOTSUPP) ? -1 : 0;
  if ((flags & (O_ACCMODE | O_DIRECTORY)) == O_RDONLY && fails(sickness.open_error)) return -1;
  return static_cast<int>(syscall(SYS_openat, AT_FDCWD, path, flags, mode));
}

int fsync(int file) {
  struct stat status {};
  const bool is_folder = ::fstat(file, &status) == 0 && S_ISDIR(status.st_mode);
  synced.emplace_back(is_folder ? "folder" : "content");
  if (fails(is_folder ? sickness.folder_sync_error : sickness.content_sync_error)) return -1;
  return static_cast<int>(syscall(SYS_fsync, file));
}

int flock(int file, int operation) {
  if (fails(sickness.lock_error)) return -1;
  return static_cast<int>(syscall(SYS_flock, file, operation));
}

}  // extern "C"

namespace earshot::host {
namespace {

namespace fs = std::filesystem;
using Order = std::vector<std::string>;

class SickDiskTest : public testing::Test {
 protected:
  SickDiskTest() {
    write_whole(path_, "older");
    synced.clear();
  }
  ~SickDiskTest() override { sickness = {}; }

  template <class Work>
  static std::string refusal(Work work) {
    try {
      work();
    } catch (const BadInput& bad) {
      sickness = {};
      return bad.what();
    }
    sickness = {};
    return {};
  }
  [[nodiscard]] std::string content() const { return read_text(path_, kAnySize); }
  [[nodiscard]] std::ptrdiff_t files() const { return std::distance(fs::directory_iterator(folder_.path()), fs::directory_iterator()); }
  [[nodiscard]] std::string unwritable(int error) const {
    return path_.string() + ": cannot be written: " + std::generic_category().message(error);
  }

  const support::TemporaryFolder folder_;
  const fs::path path_ = folder_ / "file";
};

TEST_F(SickDiskTest, ThatIsInterruptedAndTakesLittleAtATimeStillHasEveryByte) {
  sickness = {.most_at_once = 3, .interruptions = 2};
  write_whole(path_, "eleven byte");
  EXPECT_EQ(sickness.interruptions, 0);
  sickness.interruptions = 2;
  EXPECT_EQ(content(), "eleven byte");
  EXPECT_EQ(sickness.interruptions, 0);
}

TEST_F(SickDiskTest, ThatFailsInTheMiddleLeavesTheOlderFileAndNothingElse) {
  sickness.write_error = EIO;
  EXPECT_EQ(refusal([&] { write_whole(path_, "newer"); }), unwritable(EIO));
  sickness.content_sync_error = EIO;
  EXPECT_EQ(refusal([&] { write_whole(path_, "newer"); }), unwritable(EIO));
  EXPECT_EQ(content(), "older");
  EXPECT_EQ(files(), 1);
}

TEST_F(SickDiskTest, HasTheContentBeforeTheNameAndTheNameBeforeAnybodyIsTold) {
  OutputFile file(path_);
  file.write("newer");
  file.commit();
  EXPECT_EQ(synced, (Order{"content", "folder"}));
  synced.clear();
  write_new(folder_ / "other", "new");
  EXPECT_EQ(synced, (Order{"content", "folder"}));
}

TEST_F(SickDiskTest, IsNotWaitedForByWhatNeedsToSurviveItsProcessOnly) {
  OutputFile file(path_);
  file.write("newer");
  file.commit(OutputFile::Survives::kProcess);
  EXPECT_EQ(synced, Order{});
  EXPECT_EQ(content(), "newer");
}

TEST_F(SickDiskTest, ThatCannotSyncFoldersHasTheFileAllTheSame) {
  sickness.folder_sync_error = EINVAL;
  EXPECT_EQ(refusal([&] { write_whole(path_, "newer"); }), "");
  EXPECT_EQ(content(), "newer");
}

TEST_F(SickDiskTest, ThatKnowsNoFilesWithoutNamesHasANamedOneUntilItIsWholeOrLeft) {
  sickness.knows_files_without_name = false;
  {
    OutputFile file(path_);
    file.write("new");
    EXPECT_EQ(files(), 2);
    file.write("er");
    EXPECT_EQ(content(), "older");
    file.commit();
    EXPECT_EQ(content(), "newer");
    EXPECT_EQ(files(), 1);
  }
  {
    OutputFile left(path_);
    left.write("never whole");
    EXPECT_EQ(files(), 2);
  }
  EXPECT_EQ(files(), 1);
  EXPECT_EQ(content(), "newer");
}

TEST_F(SickDiskTest, ThatKnowsNoFilesWithoutNamesGivesANewOneItsNameOnce) {
  sickness.knows_files_without_name = false;
  {
    OutputFile taken(path_);
    EXPECT_EQ(refusal([&] { taken.commit_as_new(); }), path_.string() + ": cannot be written: File exists");
  }
  EXPECT_EQ(content(), "older");
  std::filesystem::remove(path_);
  OutputFile file(path_);
  file.write("new");
  file.commit_as_new();
  EXPECT_EQ(content(), "new");
  EXPECT_EQ(files(), 1);
}

TEST_F(SickDiskTest, ThatWasInterruptedLongAgoIsReadToItsEnd) {
  errno = EINTR;
  EXPECT_EQ(content(), "older");
}

TEST_F(SickDiskTest, ThatReadsLittleAtATimeGivesAsMuchAsThereIsRoomForAndNoMore) {
  InputFile file(path_, kAnySize);
  sickness.most_at_once = 3;
  std::array<std::uint8_t, 8> room{};
  EXPECT_EQ(file.read(std::span(room).first(4)), 4U);
  EXPECT_EQ(room, (std::array<std::uint8_t, 8>{'o', 'l', 'd', 'e'}));
}

TEST_F(SickDiskTest, ThatCannotReadIsTold) {
  sickness.read_error = EIO;
  EXPECT_EQ(refusal([&] { (void)content(); }), path_.string() + ": cannot be read: Input/output error");
  sickness.open_error = EACCES;
  EXPECT_EQ(refusal([&] { (void)content(); }), path_.string() + ": cannot be read: Permission denied");
}

TEST_F(SickDiskTest, ThatKnowsNoLocksIsAnErrorForAFolderAndNoneForAFile) {
  sickness.lock_error = ENOLCK;
  EXPECT_THROW((void)lock_folder(folder_), std::system_error);
  EXPECT_NO_THROW(require_not_being_written(path_));
  EXPECT_NO_THROW(require_not_being_written(folder_ / "none"));
}

}  // namespace
}  // namespace earshot::host
