#include "sim/plot/gnuplot.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "tests/support/file_size_limit.hpp"
#include "tests/support/temporary_folder.hpp"

namespace earshot::plot {
namespace {

class Picture : public testing::TestWithParam<const char*> {};

TEST_P(Picture, OfAFullDiskIsNotTakenForAWholeOne) {
  const support::TemporaryFolder folder;
  const std::filesystem::path path = folder / (std::string("p.") + GetParam());
  {
    const support::FileSizeLimit limit(500);  // gnuplot reports success whether or not its bytes found room
    EXPECT_THROW(draw(path, {.title = "a line", .size = "400,300", .commands = "plot x\n"}), std::runtime_error);
  }
  EXPECT_FALSE(std::filesystem::exists(std::filesystem::symlink_status(path)));
  EXPECT_NO_THROW(draw(path, {.title = "a line", .size = "400,300", .commands = "plot x\n"}));
  EXPECT_GT(std::filesystem::file_size(path), 1000U);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(path.parent_path()), {}), 1) << "something was left beside the picture";
}

INSTANTIATE_TEST_SUITE_P(Both, Picture, testing::Values("png", "svg"));

TEST(Gnuplot, GivesAnSvgTheTitleOfItsPictureInPlaceOfItsOwn) {
  const support::TemporaryFolder folder;
  draw(folder / "p.svg", {.title = "depth < 3 km & range", .size = "400,300", .commands = "plot x\n"});
  std::ifstream stream(folder / "p.svg");
  const std::string svg{std::istreambuf_iterator<char>(stream), {}};
  EXPECT_NE(svg.find("<title>depth &lt; 3 km &amp; range</title>"), std::string::npos);
  EXPECT_EQ(svg.find("<title>Gnuplot</title>"), std::string::npos);
}

TEST(Gnuplot, ExpandsNothingInAQuotedText) {
  EXPECT_EQ(quoted("it's `date` $x \"a\""), "'it''s `date` $x \"a\"'");
}

TEST(Gnuplot, IsGivenNoTextOfTwoLinesForTheSecondWouldBeACommand) {
  EXPECT_THROW((void)quoted("a\nsystem('date')"), std::invalid_argument);
}

TEST(Gnuplot, TakesANameThatLooksLikeACommandForAName) {
  const support::TemporaryFolder folder;
  const std::filesystem::path before = std::filesystem::current_path();
  std::filesystem::current_path((folder / "x").parent_path());
  EXPECT_NO_THROW(draw("|touch owned;.svg", {.title = "a line", .size = "400,300", .commands = "plot x\n"}));
  EXPECT_TRUE(std::filesystem::exists("|touch owned;.svg"));
  EXPECT_FALSE(std::filesystem::exists("owned"));
  std::filesystem::current_path(before);
}

}  // namespace
}  // namespace earshot::plot
