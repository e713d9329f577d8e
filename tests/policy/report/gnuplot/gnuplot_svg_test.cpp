#include "policy/report/gnuplot/gnuplot_svg.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <stdexcept>

#include "tests/support/temporary_folder.hpp"
#include "tests/support/text/tells.hpp"

namespace earshot::report {
namespace {

namespace fs = std::filesystem;

/// A folder for temporary files whose name a shell would run.
class GnuplotSvg : public testing::Test {
 protected:
  GnuplotSvg() {
    const char* const before = std::getenv("TMPDIR");
    before_ = before == nullptr ? "" : before;
    use(folder_ / "it's ';touch ran;'`touch ran`");
    fs::current_path(folder_);  // where it would touch
  }
  ~GnuplotSvg() override {
    fs::current_path("/");
    before_.empty() ? ::unsetenv("TMPDIR") : ::setenv("TMPDIR", before_.c_str(), 1);
  }
  static void use(const fs::path& temporary) {
    fs::create_directories(temporary);
    ::setenv("TMPDIR", temporary.c_str(), 1);
  }

  support::TemporaryFolder folder_;
  std::string before_;
};

TEST_F(GnuplotSvg, DrawsInAFolderWhateverItsNameAndRunsNothingInIt) {
  const PlotFolder folder;
  const std::vector<std::string> svgs = svgs_from(folder, "set terminal svg\nset output 'a.svg'\nplot x\nset output 'b.svg'\nplot -x\n",
                                                  {{"a.svg", "up"}, {"b.svg", "down"}});
  ASSERT_EQ(svgs.size(), 2U);
  for (const std::string& svg : svgs) EXPECT_EQ(svg.substr(0, 4), "<svg");
  for (const auto& entry : fs::recursive_directory_iterator(folder_)) EXPECT_NE(entry.path().filename(), "ran") << entry.path();
}

TEST_F(GnuplotSvg, NamesTheFolderForTemporaryFilesThatIsNotThere) {
  ::setenv("TMPDIR", "/nowhere", 1);
  try {
    const PlotFolder folder;
    FAIL() << "made in " << folder.path();
  } catch (const std::runtime_error& error) {
    EXPECT_TRUE(support::tells(std::string(error.what()), {"no", "made", "TMPDIR", "nowhere"}));
  }
}

TEST_F(GnuplotSvg, DrawsInTheInkOfThePageUnderTheTitleItIsGivenAndThickEnoughToBeSeen) {
  const PlotFolder folder;
  const std::string svg =
      svgs_from(folder,
                page_style("600,400") + "set output 'a.svg'\nset xlabel 'time'\nplot '-' with points pt 6 lc " + kInk + "\n1 1\n2 2\ne\n",
                {{.file = "a.svg", .title = "two rings"}})
          .front();
  EXPECT_NE(svg.find("<title>two rings</title>"), std::string::npos);
  EXPECT_NE(svg.find("fill=\"var(--ink, #1d2733)\""), std::string::npos) << "text";
  EXPECT_NE(svg.find("stroke='var(--ink, #1d2733)'"), std::string::npos) << "border";
  EXPECT_EQ(svg.find("rgb(1,2,3)"), std::string::npos);
  EXPECT_EQ(svg.find("rgb(  1,   2,   3)"), std::string::npos);
  EXPECT_EQ(svg.find("stroke-width='0.1"), std::string::npos) << "gnuplot draws its symbols with hair lines";
}

TEST_F(GnuplotSvg, TellsAScriptThatFails) {
  const PlotFolder folder;
  EXPECT_THROW((void)svgs_from(folder, "plot nothing of the kind\n", {{"a.svg", ""}}), std::runtime_error);
  EXPECT_THROW((void)svgs_from(folder, "set terminal svg\n", {{"a.svg", ""}}), std::runtime_error) << "nothing was drawn";
}

TEST_F(GnuplotSvg, RefusesAFolderWhoseNameHoldsALineBreak) {
  use(folder_ / "a\nsystem 'touch ran'\n");
  const PlotFolder folder;
  EXPECT_THROW((void)svgs_from(folder, "set terminal svg\nset output 'a.svg'\nplot x\n", {{"a.svg", ""}}), std::invalid_argument);
  EXPECT_FALSE(fs::exists(folder_ / "ran"));
}

}  // namespace
}  // namespace earshot::report
