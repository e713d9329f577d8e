#include "firmware/host/file/input_file.hpp"

#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <string>

#include <fcntl.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>
#include <sys/un.h>
#include <unistd.h>

#include "firmware/host/file/bad_input.hpp"
#include "firmware/host/file/shipped.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text/tells.hpp"

namespace earshot::host {
namespace {

namespace fs = std::filesystem;

constexpr FileKind kFourBytes{"a test", 4};

class InputFileTest : public testing::Test {
 protected:
  fs::path written(const std::string& content) {
    const fs::path path = folder_ / "file";
    std::ofstream(path, std::ios::binary) << content;
    return path;
  }

  static std::string refusal(const fs::path& path, FileKind kind = kAnySize) {
    try {
      (void)read_text(path, kind);
    } catch (const BadInput& bad) {
      return bad.what();
    }
    return {};
  }

  const support::TemporaryFolder folder_;
};

TEST_F(InputFileTest, GivesTheWholeContent) {
  const std::string content("a\0\xff\n", 4);
  EXPECT_EQ(read_text(written(content), kFourBytes), content);
  EXPECT_EQ(read_bytes(written(content), kFourBytes), (std::vector<std::uint8_t>{'a', 0, 0xff, '\n'}));
  EXPECT_EQ(read_text(written(""), kFourBytes), "");
}

TEST_F(InputFileTest, GivesAFileThatIsLongerThanOnePiece) {
  const std::string content(3'000'001, 'x');
  EXPECT_EQ(read_text(written(content), kAnySize), content);
}

TEST_F(InputFileTest, ReadsPieceByPiece) {
  const std::filesystem::path path = written("abcde");
  InputFile file(path, kAnySize);
  EXPECT_EQ(file.path(), path);
  EXPECT_EQ(file.size(), 5U);
  std::array<std::uint8_t, 3> piece{};
  EXPECT_EQ(file.read(piece), 3U);
  EXPECT_EQ(piece[2], 'c');
  EXPECT_EQ(file.read(piece), 2U);
  EXPECT_EQ(piece[1], 'e');
  EXPECT_EQ(file.read(piece), 0U);
}

TEST_F(InputFileTest, RefusesAPipeWithoutWaitingForAWriter) {
  const fs::path pipe = folder_ / "pipe";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_TRUE(support::tells(refusal(pipe), {pipe.string(), "cannot", "read", "only", "read"}));
}

TEST_F(InputFileTest, LeavesWhatIsInAPipe) {
  const fs::path pipe = folder_ / "pipe";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  const int both_ends = ::open(pipe.c_str(), O_RDWR);
  ASSERT_EQ(::write(both_ends, "abc", 3), 3);
  EXPECT_NE(refusal(pipe), "");
  std::array<char, 4> left{};
  EXPECT_EQ(::read(both_ends, left.data(), left.size()), 3);
  ::close(both_ends);
}

TEST_F(InputFileTest, RefusesADevice) {
  const fs::path node = folder_ / "zeros";
  if (mknod(node.c_str(), S_IFCHR | 0600, makedev(1, 5)) != 0) GTEST_SKIP() << "making a device node needs root";
  EXPECT_NE(refusal(node).find("it is a device"), std::string::npos) << refusal(node);
}

TEST_F(InputFileTest, RefusesASocket) {
  const int socket = ::socket(AF_UNIX, SOCK_STREAM, 0);
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  const fs::path path = folder_ / "socket";
  ASSERT_LT(path.string().size(), sizeof(address.sun_path));
  path.string().copy(address.sun_path, sizeof(address.sun_path) - 1);
  ASSERT_EQ(bind(socket, reinterpret_cast<const sockaddr*>(&address), sizeof(address)), 0);
  EXPECT_NE(refusal(path).find("it is a socket"), std::string::npos) << refusal(path);
  ::close(socket);
}

TEST_F(InputFileTest, RefusesAFolder) {
  EXPECT_EQ(refusal(folder_), folder_.path().string() + ": cannot be read: it is a folder");
}

TEST_F(InputFileTest, SaysThatThereIsNone) {
  EXPECT_EQ(refusal(folder_ / "none"), (folder_ / "none").string() + ": no such file");
  EXPECT_EQ(refusal(written("") / "below"), (folder_ / "file/below").string() + ": no such file");
}

/// READMEs name files as the source tree does; who has packages stands elsewhere.
TEST_F(InputFileTest, SaysWhereTheOneThatShipsIsAndDoesNotOpenIt) {
  const fs::path data = folder_ / "data";
  fs::create_directories(data / "some/worlds");
  std::ofstream(data / "some/worlds/noisy.toml") << "seed = 1\n";
  setenv(kDataVariable, data.c_str(), 1);
  EXPECT_TRUE(support::tells(refusal("some/worlds/noisy.toml"),
                             {"some/worlds/noisy.toml", "no", "file", "ships", (data / "some/worlds/noisy.toml").string()}));
  EXPECT_EQ(refusal("some/worlds/none.toml"), "some/worlds/none.toml: no such file");
  EXPECT_EQ(refusal("some/worlds"), "some/worlds: no such file");
  EXPECT_EQ(refusal("/nowhere/some/worlds/noisy.toml"), "/nowhere/some/worlds/noisy.toml: no such file");
  unsetenv(kDataVariable);
}

TEST_F(InputFileTest, RefusesOneByteMoreThanItsKindHas) {
  EXPECT_EQ(refusal(written("1234"), kFourBytes), "");
  EXPECT_TRUE(support::tells(refusal(written("12345"), kFourBytes), {(folder_ / "file").string(), "5 bytes", "more", "at most 4"}));
}

TEST_F(InputFileTest, RefusesASparseFileBySizeAlone) {
  const fs::path path = written("");
  fs::resize_file(path, std::uintmax_t{3} << 30U);
  EXPECT_TRUE(support::has_line(refusal(path, kCsvFile), {"3221225472 bytes", "more", "CSV", "at most"}));
}

TEST_F(InputFileTest, RefusesAFileThatGrewBeyondItsKindWhileItWasRead) {
  const fs::path path = written("1234");
  InputFile file(path, kFourBytes);
  std::ofstream(path, std::ios::app) << "5";
  std::array<std::uint8_t, 8> room{};
  EXPECT_THROW((void)file.read(room), BadInput);
}

TEST_F(InputFileTest, ReadsAFileWhoseSizeTheSystemDoesNotSay) {
  const std::string status = read_text("/proc/self/status", kAnySize);
  EXPECT_EQ(status.rfind("Name:", 0), 0U);
  EXPECT_EQ(status.back(), '\n');
}

TEST_F(InputFileTest, FollowsALinkToAFile) {
  fs::create_symlink(written("abcd"), folder_ / "link");
  EXPECT_EQ(read_text(folder_ / "link", kFourBytes), "abcd");
}

TEST_F(InputFileTest, SpellsOutControlCharactersOfANameEvenALineFeed) {
  EXPECT_EQ(refusal("/nowhere/\x1b[2J\n"), "/nowhere/\\x1b[2J\\n: no such file");
}

}  // namespace
}  // namespace earshot::host
