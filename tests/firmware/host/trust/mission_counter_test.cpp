#include "firmware/host/trust/mission_counter.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "firmware/host/file/folder_lock.hpp"
#include "firmware/host/trust/keys.hpp"
#include "tests/firmware/host/trust/complaint.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text/tells.hpp"

namespace {
bool killed_before_rename = false;
}  // namespace

/// The C library's, but for a process that dies between having written a file and giving it its name.
extern "C" int rename(const char* from, const char* to) noexcept {
  if (killed_before_rename) (void)std::raise(SIGKILL);
  return ::renameat(AT_FDCWD, from, AT_FDCWD, to);
}

namespace earshot::host {
namespace {

namespace fs = std::filesystem;

/// CRC-32 by Python's zlib.crc32, the hashes those of "a mission\n" and "a policy\n".
const std::string kText =
    "Earshot mission counter 1\n"
    "counter 258\n"
    "mission_sha256 879cf39c20fd722801faebd0d7d422baf59057129ba2886ef2240a1e27b78bc4\n"
    "policy_sha256 8f20683e4c9e991589cad8b12dbd690d94972e3638de384889ef7524abb0e11b\n"
    "crc32 8f6fafa8\n";

authority::MissionManifest numbered(std::uint64_t counter) {
  return {.counter = counter, .mission = sha256_of(std::string_view("a mission\n")), .policy = sha256_of(std::string_view("a policy\n"))};
}

class MissionCounterFile : public testing::Test {
 protected:
  void write(const std::string& text) const { std::ofstream(file_) << text; }
  [[nodiscard]] std::string content() const {
    std::ifstream stream(file_);
    return {std::istreambuf_iterator<char>(stream), {}};
  }
  [[nodiscard]] std::string complaint() const {
    return complaint_of([this] { MissionCounter counter(file_); });
  }

  const support::TemporaryFolder folder_;
  const fs::path file_ = folder_ / "mission.counter";
};

TEST_F(MissionCounterFile, KeepsWhatFlewLast) {
  begin_counter(file_, 0);
  EXPECT_EQ(read_flown_last(file_), authority::MissionManifest{});
  {
    MissionCounter counter(file_);
    counter.record(numbered(258));
    EXPECT_EQ(counter.flown_last(), numbered(258));
  }
  EXPECT_EQ(content(), kText);
  EXPECT_EQ(read_flown_last(file_), numbered(258));
}

TEST_F(MissionCounterFile, BeginsWhereItIsTold) {
  begin_counter(file_, 41);
  EXPECT_EQ(read_flown_last(file_).counter, 41U);
}

TEST_F(MissionCounterFile, IsItsOwnersAloneToWriteWhateverTheUmask) {
  const mode_t before = ::umask(0);
  begin_counter(file_, 0);
  MissionCounter(file_).record(numbered(258));
  ::umask(before);
  EXPECT_EQ(fs::status(file_).permissions(), fs::perms{0644});
}

TEST_F(MissionCounterFile, IsRaisedByAPersonAndNeverLowered) {
  write(kText);
  raise_counter(file_, 5'000'000'000);
  EXPECT_EQ(read_flown_last(file_), (authority::MissionManifest{.counter = 5'000'000'000, .mission = {}, .policy = {}}));
  const std::string raised = content();
  EXPECT_TRUE(support::tells(complaint_of([this] { raise_counter(file_, 5'000'000'000); }),
                             {file_.string(), "stands", "5000000000", "raised", "only"}));
  EXPECT_EQ(content(), raised);
  EXPECT_NE(complaint_of([this] { raise_counter(folder_ / "none", 9); }).find("no such file"), std::string::npos);
  const MissionCounter held(file_);
  EXPECT_THROW(raise_counter(file_, 6'000'000'000), FolderInUse) << "of a vehicle that flies";
}

TEST_F(MissionCounterFile, IsNeverBegunAnew) {
  write(kText);
  EXPECT_TRUE(support::tells(complaint_of([this] { begin_counter(file_, 0); }),
                             {file_.string(), "already", "never replaced", "knows", "vehicle", "damaged"}));
  EXPECT_EQ(content(), kText);
}

TEST_F(MissionCounterFile, ThatIsNotThereIsRefusedWithWhatMakesIt) {
  const std::string said = complaint();
  EXPECT_NE(said.find("no such file"), std::string::npos) << said;
  EXPECT_NE(said.find("earshot verify --new-counter N"), std::string::npos) << said;
  EXPECT_NE(complaint_of([this] { MissionCounter counter(folder_ / "none" / "mission.counter"); }).find("no such file"), std::string::npos);
}

TEST_F(MissionCounterFile, ThatIsDamagedIsRefusedAndStays) {
  for (std::size_t i = 0; i < kText.size(); ++i) {
    std::string damaged = kText;
    damaged[i] = damaged[i] == '1' ? '2' : '1';
    write(damaged);
    EXPECT_NE(complaint(), "") << "byte " << i;
    EXPECT_EQ(content(), damaged);
  }
  for (const std::string& text : {std::string(), kText.substr(0, 100), kText + "\n", kText + kText}) {
    write(text);
    EXPECT_NE(complaint(), "") << text;
    EXPECT_EQ(content(), text);
  }
  std::string lower = kText;
  lower.replace(lower.find("258"), 3, "257");
  write(lower);
  EXPECT_NE(complaint().find("is damaged: its CRC-32 is wrong"), std::string::npos) << complaint();
}

TEST_F(MissionCounterFile, ThatIsNoRegularFileIsRefusedAndStays) {
  ASSERT_EQ(::mkfifo(file_.c_str(), 0600), 0);
  EXPECT_NE(complaint().find("it is a pipe"), std::string::npos);
  EXPECT_TRUE(fs::is_fifo(file_));
  EXPECT_NE(complaint_of([] { MissionCounter counter("/dev/zero"); }).find("it is a device"), std::string::npos);
}

TEST_F(MissionCounterFile, IsWrittenWhereItsLinkLeads) {
  begin_counter(file_, 0);
  fs::create_directory(folder_ / "etc");
  fs::create_symlink("../mission.counter", folder_ / "etc" / "counter");
  MissionCounter(folder_ / "etc" / "counter").record(numbered(258));
  EXPECT_EQ(content(), kText);
  EXPECT_TRUE(fs::is_symlink(folder_ / "etc" / "counter"));
}

TEST_F(MissionCounterFile, IsOneProgramsAtATime) {
  begin_counter(file_, 0);
  const MissionCounter held(file_);
  EXPECT_THROW(MissionCounter second(file_), FolderInUse);
  EXPECT_EQ(read_flown_last(file_).counter, 0U) << "a checklist may be made meanwhile";
}

TEST_F(MissionCounterFile, OfAProgramThatIsKilledBeforeItsNewOneHasItsNameIsTheOldOneWhole) {
  begin_counter(file_, 7);
  const std::string before = content();
  const pid_t child = ::fork();
  if (child == 0) {
    MissionCounter counter(file_);
    killed_before_rename = true;
    counter.record(numbered(258));
    std::_Exit(0);
  }
  int status = 0;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL) << status;
  EXPECT_EQ(content(), before);
  MissionCounter(file_).record(numbered(258));
  EXPECT_EQ(content(), kText) << "the lock went with the process";
}

}  // namespace
}  // namespace earshot::host
