#include "policy/command_line/outputs.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <vector>

#include "firmware/host/file/bad_input.hpp"
#include "tests/support/temporary_folder.hpp"

namespace earshot::command_line {
namespace {

template <class Work>
std::string refusal(Work work) {
  try {
    work();
  } catch (const host::BadInput& bad) {
    return bad.what();
  }
  return "not refused";
}

TEST(Outputs, MayNotBeOneFileUnderTwoNames) {
  const support::TemporaryFolder folder;
  std::filesystem::create_directory(folder / "a");
  std::filesystem::create_directory_symlink("a", folder / "link");
  const std::string first = folder / "a/x.svg";
  for (const std::filesystem::path& second : {folder / "a/x.svg", folder / "a/../a/./x.svg", folder / "link/x.svg"}) {
    const std::vector<Output> files{{"--csv", first, host::kSvgOutput}, {"--plot", second, host::kSvgOutput}};
    EXPECT_EQ(refusal([&] { check_distinct(files); }),
              "--csv " + first + ", --plot " + second.string() + ": the same file, one would replace the other");
    EXPECT_EQ(refusal([&] { require_writable(files, host::Replace::kAny); }), refusal([&] { check_distinct(files); }));
  }
  const std::vector<Output> two{{"--csv", first, host::kSvgOutput}, {"--plot", folder / "x.svg", host::kSvgOutput}};
  EXPECT_EQ(refusal([&] { check_distinct(two); }), "not refused");
}

TEST(Outputs, MayNotBeOneFileUnderTwoHardLinks) {
  const support::TemporaryFolder folder;
  std::ofstream(folder / "a.svg") << "<svg";
  std::filesystem::create_hard_link(folder / "a.svg", folder / "b.svg");
  const std::vector<Output> files{{"--csv", folder / "a.svg", host::kSvgOutput}, {"--plot", folder / "b.svg", host::kSvgOutput}};
  EXPECT_NE(refusal([&] { check_distinct(files); }).find(": the same file"), std::string::npos);
}

TEST(Outputs, AreNoneOfTheFilesThatAreRead) {
  const support::TemporaryFolder folder;
  std::ofstream(folder / "a.policy") << "mine";
  std::filesystem::create_symlink("a.policy", folder / "link");
  const std::vector<Output> files{{"--csv", folder / "x.csv", {}}, {"--json", folder / "link", {}}};
  EXPECT_EQ(refusal([&] { check_is_none_of(files, "POLICY", folder / "a.policy"); }), "POLICY " + (folder / "a.policy").string() +
                                                                                          ", --json " + (folder / "link").string() +
                                                                                          ": the same file, one would replace the other");
  EXPECT_EQ(refusal([&] { check_is_none_of(files, "POLICY", folder / "b.policy"); }), "not refused");
}

TEST(Outputs, AreAllJudgedBeforeOneIsWritten) {
  const support::TemporaryFolder folder;
  std::ofstream(folder / "notes.svg") << "[seabed]\n";
  const std::vector<Output> files{{"--csv", folder / "new.svg", host::kSvgOutput}, {"--plot", folder / "notes.svg", host::kSvgOutput}};
  EXPECT_EQ(refusal([&] { require_writable(files, host::Replace::kOwnKind); }),
            (folder / "notes.svg").string() + ": is there already and is not an SVG picture; --force replaces it");
  EXPECT_EQ(refusal([&] { require_writable(files, host::Replace::kAny); }), "not refused");
  EXPECT_FALSE(std::filesystem::exists(folder / "new.svg"));
}

TEST(Outputs, ThatArePicturesEndInPngOrSvg) {
  EXPECT_EQ(refusal([] { check_picture_name("-o", "map.pdf"); }), "-o map.pdf: must end in .png or .svg");
  for (const char* name : {"map.png", "a.b/map.svg"}) EXPECT_EQ(refusal([&] { check_picture_name("-o", name); }), "not refused") << name;
}

}  // namespace
}  // namespace earshot::command_line
