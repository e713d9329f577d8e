#include "firmware/host/trust/strict_modes.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "tests/firmware/host/trust/complaint.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text/tells.hpp"

namespace earshot::host {
namespace {

namespace fs = std::filesystem;

class StrictModes : public testing::Test {
 protected:
  StrictModes() {
    fs::create_directories(folder_ / "etc/keys");
    for (const char* const folder : {"etc", "etc/keys"}) EXPECT_EQ(::chmod((folder_ / folder).c_str(), 0755), 0);
    for (const fs::path& file : {file_, key_}) {
      std::ofstream(file) << "x";
      EXPECT_EQ(::chmod(file.c_str(), 0644), 0);
    }
  }
  [[nodiscard]] std::string complaint(const std::vector<fs::path>& files) const {
    return complaint_of([&] { require_strict_modes(files); });
  }
  [[nodiscard]] std::string complaint() const { return complaint({file_}); }
  static void set_mode(const fs::path& path, mode_t mode) { ASSERT_EQ(::chmod(path.c_str(), mode), 0); }

  const support::TemporaryFolder folder_;  // in /tmp, which everybody writes and whose sticky bit is set
  const fs::path file_ = folder_ / "etc/vehicle.toml";
  const fs::path key_ = folder_ / "etc/keys/ops.pub";
};

TEST_F(StrictModes, AcceptWhatRootAndThisUserAloneCanChange) {
  EXPECT_EQ(complaint({file_, key_}), "");
  set_mode(file_, 0600);
  EXPECT_EQ(complaint(), "");
  EXPECT_EQ(complaint({"/etc/passwd"}), "") << "which is root's";
}

TEST_F(StrictModes, RefuseAFileThatItsGroupOrEverybodyMayWrite) {
  set_mode(file_, 0664);
  EXPECT_TRUE(support::has_line(complaint(), {file_.string(), "written", "group", "it", file_.string()})) << complaint();
  set_mode(file_, 0646);
  EXPECT_NE(complaint().find(file_.string() + " may be written by everybody"), std::string::npos) << complaint();
}

TEST_F(StrictModes, RefuseAFolderAnywhereAboveThatOthersMayWrite) {
  set_mode(folder_.path(), 0775);
  EXPECT_NE(complaint().find(folder_.path().string() + " may be written by its group"), std::string::npos) << complaint();
  set_mode(folder_.path(), 0700);
  set_mode(folder_ / "etc", 0777);
  EXPECT_NE(complaint().find("etc may be written by everybody"), std::string::npos) << complaint();
  set_mode(folder_ / "etc", 01777);
  EXPECT_EQ(complaint(), "") << "in a folder with the sticky bit nobody renames what is another's";
}

TEST_F(StrictModes, NameAllThatIsWrongAtOnceAndEachThingOnce) {
  set_mode(folder_ / "etc", 0775);
  set_mode(key_, 0666);
  const std::string said = complaint({file_, key_});
  EXPECT_TRUE(support::has_line(said, {file_.string(), "changed by others than root"})) << said;
  EXPECT_TRUE(said.ends_with("What mends it: chmod go-w " + (folder_ / "etc").string() + " " + key_.string())) << said;
  set_mode(folder_ / "etc", 0755);
  set_mode(key_, 0644);
  EXPECT_EQ(complaint({file_, key_}), "");
}

TEST_F(StrictModes, FollowLinksAndJudgeBothTheirPlaceAndWhereTheyLead) {
  fs::create_directory(folder_ / "open");
  set_mode(folder_ / "open", 0777);
  fs::create_symlink("../etc/vehicle.toml", folder_ / "open/link.toml");
  EXPECT_NE(complaint({folder_ / "open/link.toml"}).find("open may be written by everybody"), std::string::npos)
      << "who may replace the link";
  fs::create_symlink(folder_ / "open", folder_ / "etc/over");
  std::ofstream(folder_ / "open/vehicle.toml") << "x";
  EXPECT_NE(complaint({folder_ / "etc/over/vehicle.toml"}).find("open may be written by everybody"), std::string::npos);
  fs::create_symlink(folder_ / "etc/keys", folder_ / "etc/again");
  EXPECT_EQ(complaint({folder_ / "etc/again/../keys/ops.pub"}), "");
  fs::create_symlink("loop", folder_ / "loop");
  EXPECT_NE(complaint({folder_ / "loop"}).find("leads from link to link"), std::string::npos);
}

TEST_F(StrictModes, JudgeTheFoldersOfAFileThatIsNotThere) {
  EXPECT_EQ(complaint({folder_ / "etc/mission.counter"}), "");
  set_mode(folder_ / "etc", 0777);
  EXPECT_NE(complaint({folder_ / "etc/mission.counter"}).find("etc may be written by everybody"), std::string::npos);
}

TEST_F(StrictModes, RefuseWhatBelongsToSomebodyElse) {
  if (::geteuid() != 0) GTEST_SKIP() << "only root gives files away";
  ASSERT_EQ(::chown(key_.c_str(), 4711, 4711), 0);
  const std::string said = complaint({file_, key_});
  EXPECT_TRUE(support::has_line(said, {"ops.pub", "4711", "it", key_.string(), "owner"})) << said;
}

}  // namespace
}  // namespace earshot::host
