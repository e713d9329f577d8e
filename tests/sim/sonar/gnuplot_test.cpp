#include "sim/sonar/gnuplot.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <string>

#include "tests/sim/netcdf/temporary_folder.hpp"

namespace earshot::sonar {
namespace {

class Picture : public testing::TestWithParam<const char*> {};

TEST_P(Picture, OfAFullDiskIsNotTakenForAWholeOne) {
  const tests::TemporaryFolder folder;
  const std::filesystem::path path = folder / (std::string("p.") + GetParam());
  // Where gnuplot writes; it reports success whether or not its bytes found room.
  std::filesystem::create_symlink("/dev/full", path.string() + ".part" + std::to_string(getpid()));
  EXPECT_THROW(draw(path, "400,300", "plot x\n"), std::runtime_error);
  EXPECT_FALSE(std::filesystem::exists(std::filesystem::symlink_status(path)));
  EXPECT_NO_THROW(draw(path, "400,300", "plot x\n"));
  EXPECT_GT(std::filesystem::file_size(path), 1000U);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(path.parent_path()), {}), 1) << "something was left beside the picture";
}

INSTANTIATE_TEST_SUITE_P(Both, Picture, testing::Values("png", "svg"));

TEST(Gnuplot, ExpandsNothingInAQuotedText) {
  EXPECT_EQ(quoted("it's `date` $x \"a\""), "'it''s `date` $x \"a\"'");
}

TEST(Gnuplot, IsGivenNoTextOfTwoLinesForTheSecondWouldBeACommand) {
  EXPECT_THROW((void)quoted("a\nsystem('date')"), std::invalid_argument);
}

TEST(Gnuplot, TakesANameThatLooksLikeACommandForAName) {
  const tests::TemporaryFolder folder;
  const std::filesystem::path before = std::filesystem::current_path();
  std::filesystem::current_path((folder / "x").parent_path());
  EXPECT_NO_THROW(draw("|touch owned;.svg", "400,300", "plot x\n"));
  EXPECT_TRUE(std::filesystem::exists("|touch owned;.svg"));
  EXPECT_FALSE(std::filesystem::exists("owned"));
  std::filesystem::current_path(before);
}

}  // namespace
}  // namespace earshot::sonar
