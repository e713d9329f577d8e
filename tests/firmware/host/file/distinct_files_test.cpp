#include "firmware/host/file/distinct_files.hpp"

#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <fstream>

#include "firmware/host/file/bad_input.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text/tells.hpp"

namespace earshot::host {
namespace {

namespace fs = std::filesystem;

template <class Work>
std::string refusal(Work work) {
  try {
    work();
  } catch (const BadInput& bad) {
    return bad.what();
  }
  return "not refused";
}

TEST(DistinctFiles, RefusesToWriteWhatIsReadByWhateverName) {
  const support::TemporaryFolder folder;
  std::ofstream(folder / "journal") << "mine";
  fs::create_symlink("journal", folder / "link");
  fs::create_hard_link(folder / "journal", folder / "hard");
  fs::create_directory_symlink(".", folder / "here");
  for (const char* name : {"journal", "link", "./journal", "there/../journal", "here/journal", "hard", "here/hard"}) {
    const std::string told =
        "JOURNAL " + (folder / "journal").string() + ", --csv " + (folder / name).string() + ": the same file, one would replace the other";
    EXPECT_EQ(refusal([&] {
                DistinctFiles files;
                files.read("JOURNAL", folder / "journal");
                files.write("--csv", folder / "other");
                files.write("--csv", folder / name);
              }),
              told);
    EXPECT_EQ(refusal([&] {
                DistinctFiles files;
                files.write("--csv", folder / "other");
                files.write("--csv", folder / name);
                files.read("JOURNAL", folder / "journal");
              }),
              told);
  }
}

TEST(DistinctFiles, RefusesToWriteOneFileTwice) {
  const support::TemporaryFolder folder;
  fs::create_symlink("map", folder / "link");  // to what is not there yet
  for (const char* name : {"map", "./map", "link"}) {
    DistinctFiles files;
    files.write("--map", folder / "map");
    EXPECT_TRUE(support::tells(refusal([&] { files.write("--json", folder / name); }),
                               {"--map", (folder / "map").string(), "--json", (folder / name).string(), "same file", "replace"}));
  }
}

TEST(DistinctFiles, LetsOneFileBeReadTwiceAndOthersBeWritten) {
  const support::TemporaryFolder folder;
  for (const char* name : {"a", "b"}) std::ofstream(folder / name) << "alike";
  DistinctFiles files;
  files.read("--expected", std::array{folder / "a", folder / "a", folder / "not there"});
  EXPECT_EQ(refusal([&] { files.write("-o", folder / "b"); }), "not refused");
  EXPECT_EQ(refusal([&] { files.write("--plot", folder / "new"); }), "not refused");
}

TEST(DistinctFiles, AreAllJudgedBeforeOneIsWritten) {
  const support::TemporaryFolder folder;
  std::ofstream(folder / "notes.svg") << "[seabed]\n";
  const std::array outputs{Output{"--map", folder / "new.svg", kSvgOutput}, Output{"--plot", folder / "notes.svg", kSvgOutput}};
  EXPECT_TRUE(support::tells(refusal([&] { require_writable({}, outputs, Replace::kOwnKind); }),
                             {(folder / "notes.svg").string(), kSvgOutput.name, "--force"}));
  EXPECT_EQ(refusal([&] { require_writable({}, outputs, Replace::kAny); }), "not refused");
  DistinctFiles read;
  read.read("--track", folder / "notes.svg");
  EXPECT_NE(refusal([&] { require_writable(read, outputs, Replace::kAny); }).find(": the same file"), std::string::npos);
  EXPECT_FALSE(fs::exists(folder / "new.svg"));
}

}  // namespace
}  // namespace earshot::host
