#include "firmware/host/file/output_file.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>
#include <sys/un.h>
#include <unistd.h>

#include "firmware/host/file/bad_input.hpp"
#include "firmware/host/file/input_file.hpp"
#include "tests/support/file_size_limit.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text/tells.hpp"

namespace earshot::host {
namespace {

namespace fs = std::filesystem;

constexpr OutputKind kNotes{"a file of notes", {"note:", {}}};

class OutputFileTest : public testing::Test {
 protected:
  template <class Work>
  static std::string refusal(Work work) {
    try {
      work();
    } catch (const BadInput& bad) {
      return bad.what();
    }
    return {};
  }

  /// What is no regular file stays, whether it is judged before the work or written to after it.
  void expect_stays(mode_t type, const std::string& why) {
    for (const Replace replace : {Replace::kOwnKind, Replace::kAny})
      EXPECT_EQ(refusal([&] { require_writable(path_, kNotes, replace); }), path_.string() + ": cannot be written: it is " + why);
    EXPECT_EQ(refusal([&] { write_whole(path_, "note: 1"); }), path_.string() + ": cannot be written: it is " + why);
    struct stat status {};
    ASSERT_EQ(lstat(path_.c_str(), &status), 0);
    EXPECT_EQ(status.st_mode & S_IFMT, type);
    EXPECT_EQ(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()), 1) << "left something behind";
  }

  [[nodiscard]] std::string content() const { return read_text(path_, kAnySize); }

  const support::TemporaryFolder folder_;
  const fs::path path_ = folder_ / "file";
};

TEST_F(OutputFileTest, ReplacesAFileOfItsKindWhole) {
  write_whole(path_, "note: an older and longer one");
  require_writable(path_, kNotes, Replace::kOwnKind);
  write_whole(path_, "note: 2");
  EXPECT_EQ(content(), "note: 2");
}

TEST_F(OutputFileTest, LeavesAFileOfAnotherKindUnlessForced) {
  write_whole(path_, "[seabed]\ndepth_m = 3000\n");
  EXPECT_TRUE(support::tells(refusal([&] { require_writable(path_, kNotes, Replace::kOwnKind); }),
                             {path_.string(), "already", "not", "notes", "--force", "replaces"}));
  EXPECT_EQ(refusal([&] { require_writable(path_, kNotes, Replace::kAny); }), "");
  EXPECT_EQ(content(), "[seabed]\ndepth_m = 3000\n");
}

/// Others write files that begin as ours do: a chart in NetCDF.
TEST_F(OutputFileTest, KnowsItsOwnByAMarkWhereverItStands) {
  constexpr OutputKind kMarked{"a file of marks", {"CDF", {}}, "Earshot, "};
  const auto refused = [&] { return refusal([&] { require_writable(path_, kMarked, Replace::kOwnKind); }); };
  constexpr std::size_t kPiece = std::size_t{1} << 20U;  // as much as is read at once
  for (const std::size_t before : {std::size_t{0}, std::size_t{90}, kPiece - 12, kPiece - 8, kPiece - 3, kPiece, 2 * kPiece - 14}) {
    write_whole(path_, "CDF" + std::string(before, '.') + "Earshot, a model");
    EXPECT_EQ(refused(), "") << before;
    write_whole(path_, "CDF" + std::string(before, '.') + "Earshot. another");
    EXPECT_NE(refused().find("is not a file of marks"), std::string::npos) << before;
  }
  write_whole(path_, "CDE Earshot, ");
  EXPECT_NE(refused(), "");
}

TEST_F(OutputFileTest, ReplacesNoFileUnaskedWhoseKindDoesNotTellWhoseItIs) {
  constexpr OutputKind kUntold{.name = "known to be mine", .beginnings = {"note"}, .is_recognisable = false};
  write_whole(path_, "note: 1");
  EXPECT_EQ(refusal([&] { require_writable(path_, kUntold, Replace::kOwnKind); }),
            path_.string() + ": is there already and is not known to be mine; --force replaces it");
  EXPECT_EQ(refusal([&] { require_writable(path_, kUntold, Replace::kAny); }), "");
  write_whole(path_, "");
  EXPECT_EQ(refusal([&] { require_writable(path_, kUntold, Replace::kOwnKind); }), "");
}

TEST_F(OutputFileTest, TakesAnEmptyFileForItsOwn) {
  write_whole(path_, "");
  EXPECT_EQ(refusal([&] { require_writable(path_, kNotes, Replace::kOwnKind); }), "");
}

TEST(PictureKind, IsWhatTheNameEndsWith) {
  EXPECT_EQ(picture_kind("map.png").name, kPngOutput.name);
  EXPECT_EQ(picture_kind("map.svg").name, kSvgOutput.name);
}

TEST_F(OutputFileTest, LeavesAPipe) {
  ASSERT_EQ(mkfifo(path_.c_str(), 0600), 0);
  expect_stays(S_IFIFO, "a pipe, and only regular files are replaced");
}

TEST_F(OutputFileTest, LeavesADevice) {
  if (mknod(path_.c_str(), S_IFCHR | 0600, makedev(1, 7)) != 0) GTEST_SKIP() << "only root makes devices";
  expect_stays(S_IFCHR, "a device, and only regular files are replaced");
}

TEST_F(OutputFileTest, LeavesASocket) {
  const int socket_number = socket(AF_UNIX, SOCK_STREAM, 0);
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  ASSERT_LT(path_.string().size(), sizeof address.sun_path);
  path_.string().copy(address.sun_path, path_.string().size());
  ASSERT_EQ(bind(socket_number, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
  close(socket_number);
  expect_stays(S_IFSOCK, "a socket, and only regular files are replaced");
}

TEST_F(OutputFileTest, LeavesAFolder) {
  fs::create_directory(path_);
  expect_stays(S_IFDIR, "a folder, and only regular files are replaced");
}

TEST_F(OutputFileTest, WritesToWhereSymbolicLinksEnd) {
  fs::create_directory(folder_ / "elsewhere");
  fs::create_symlink("second", path_);
  fs::create_symlink("elsewhere/target", folder_ / "second");
  for (const char* text : {"note: made", "note: replaced"}) {
    write_whole(path_, text);
    EXPECT_TRUE(fs::is_symlink(path_));
    EXPECT_EQ(read_text(folder_ / "elsewhere/target", kAnySize), text);
  }
}

TEST_F(OutputFileTest, LeavesAPipeBehindASymbolicLink) {
  ASSERT_EQ(mkfifo((folder_ / "pipe").c_str(), 0600), 0);
  fs::create_symlink("pipe", path_);
  EXPECT_NE(refusal([&] { write_whole(path_, "note: 1"); }), "");
  EXPECT_TRUE(fs::is_symlink(path_));
  EXPECT_TRUE(fs::is_fifo(folder_ / "pipe"));
}

TEST_F(OutputFileTest, RefusesLinksThatGoRound) {
  fs::create_symlink("file", path_);
  EXPECT_NE(refusal([&] { write_whole(path_, "note: 1"); }), "");
}

TEST_F(OutputFileTest, KeepsWhoMayReadTheOlderFile) {
  write_whole(path_, "note: secret");
  fs::permissions(path_, fs::perms::owner_read | fs::perms::owner_write);
  write_whole(path_, "note: 2");
  EXPECT_EQ(fs::status(path_).permissions(), fs::perms::owner_read | fs::perms::owner_write);
}

TEST_F(OutputFileTest, KeepsASecretFromOthersFromTheFirstByte) {
  OutputFile file(path_, Access::kOwnerOnly);
  EXPECT_EQ(fs::status(file.partial()).permissions(), fs::perms::owner_read | fs::perms::owner_write);
}

TEST_F(OutputFileTest, KeepsASecretFromWhoeverCouldReadTheOlderFile) {
  write_whole(path_, "note: open");
  fs::permissions(path_, fs::perms::owner_read | fs::perms::owner_write | fs::perms::others_read);
  write_whole(path_, "note: secret", Access::kOwnerOnly);
  EXPECT_EQ(fs::status(path_).permissions(), fs::perms::owner_read | fs::perms::owner_write);
}

TEST_F(OutputFileTest, SaysWhatIsInTheWayOfItsPart) {
  const fs::path part = path_.string() + ".part" + std::to_string(::getpid());
  fs::create_directory(part);
  errno = ENOENT;
  EXPECT_EQ(refusal([&] { write_whole(path_, "note: 1"); }),
            path_.string() + ": cannot be written: " + part.filename().string() + " is in the way");
  EXPECT_TRUE(fs::is_directory(part));
}

TEST_F(OutputFileTest, LeavesAPipeThatCameInTheMeantime) {
  OutputFile file(path_);
  file.write("note: late");
  ASSERT_EQ(::mkfifo(path_.c_str(), 0600), 0);
  EXPECT_NE(refusal([&] { file.commit(); }), "");
  EXPECT_TRUE(fs::is_fifo(path_));
}

TEST_F(OutputFileTest, LeavesTheOlderFileAndNothingElseWhereTheDiskIsFull) {
  write_whole(path_, "note: older");
  const std::string said = [&] {
    const support::FileSizeLimit limit(1000);
    return refusal([&] { write_whole(path_, std::string(100'000, 'x')); });
  }();
  EXPECT_EQ(said, path_.string() + ": cannot be written: File too large");
  EXPECT_EQ(content(), "note: older");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()), 1);
}

TEST_F(OutputFileTest, LeavesNothingOfAFileThatWasNotFinished) {
  {
    OutputFile file(path_);
    file.write("note: half");
  }
  EXPECT_TRUE(fs::is_empty(folder_));
}

TEST_F(OutputFileTest, HasNoNameThatAKillWouldLeaveUntilItIsWhole) {
  OutputFile file(path_);
  file.write("note: half");
  EXPECT_TRUE(fs::is_empty(folder_));
  file.commit();
  EXPECT_EQ(content(), "note: half");
}

TEST_F(OutputFileTest, KeepsWhatALibraryWroteByName) {
  OutputFile file(path_);
  std::ofstream(file.partial()) << "note: by name";
  file.commit();
  EXPECT_EQ(content(), "note: by name");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()), 1);
}

TEST_F(OutputFileTest, IsNewToOneOfTwoThatMakeIt) {
  OutputFile first(path_);
  OutputFile second(path_);
  first.write("note: first");
  second.write("note: second");
  second.commit_as_new();
  EXPECT_EQ(refusal([&] { first.commit_as_new(); }), path_.string() + ": cannot be written: File exists");
  EXPECT_EQ(content(), "note: second");
}

TEST_F(OutputFileTest, IsNewToOneOfTwoWhereItHadAName) {
  OutputFile file(path_);
  (void)file.partial();
  std::ofstream(path_) << "note: other";
  EXPECT_EQ(refusal([&] { file.commit_as_new(); }), path_.string() + ": cannot be written: File exists");
  EXPECT_EQ(content(), "note: other");
}

TEST_F(OutputFileTest, IsNewAndLeavesNothingElseWhereItHadAName) {
  {
    OutputFile file(path_);
    file.write("note: named");
    (void)file.partial();
    file.commit_as_new();
  }
  EXPECT_EQ(content(), "note: named");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()), 1);
}

TEST_F(OutputFileTest, IsRefusedBeforeTheWorkWhereItsNameIsTooLong) {
  const fs::path longest = folder_ / std::string(255, 'x');
  EXPECT_EQ(refusal([&] { require_writable(longest, kNotes, Replace::kOwnKind); }),
            longest.string() + ": cannot be written: File name too long");
}

TEST_F(OutputFileTest, NamesAFolderThatIsNotThere) {
  const fs::path lost = folder_ / "no" / "file";
  EXPECT_TRUE(support::tells(refusal([&] { require_writable(lost, kNotes, Replace::kOwnKind); }),
                             {lost.string(), "cannot", "written", "No", "file", "directory"}));
}

}  // namespace
}  // namespace earshot::host
