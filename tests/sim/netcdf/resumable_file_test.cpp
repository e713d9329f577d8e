#include "sim/netcdf/resumable_file.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "tests/support/temporary_folder.hpp"
#include "tests/support/text/tells.hpp"

namespace earshot::netcdf {
namespace {

Layout layout(const std::string& purpose = "first", std::size_t length = 4) {
  return {.attributes = {{"purpose", purpose}},
          .dimensions = {{"x", length}},
          .variables = {{"done", Type::kInt32, {"x"}, {}, 0.0},
                        {"value", Type::kFloat, {"x"}, {{"units", "dB"}}, std::numeric_limits<double>::quiet_NaN()}}};
}

void put(ResumableFile& file, std::size_t x, double value) {
  file.write("value", {.start = {x}, .count = {1}}, std::vector<double>{value});
  file.write("done", {.start = {x}, .count = {1}}, std::vector<double>{1.0});
}

std::string bytes(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

std::string complaint(const std::filesystem::path& path, const Layout& wanted) {
  try {
    const ResumableFile file(path, wanted);
  } catch (const FileError& e) {
    return e.what();
  }
  return "none";
}

TEST(ResumableFile, HoldsFillValuesWhereNothingWasWritten) {
  const support::TemporaryFolder folder;
  ResumableFile file(folder / "f.nc", layout());
  put(file, 2, 80.5);
  EXPECT_EQ(file.read("done"), (std::vector<double>{0, 0, 1, 0}));
  EXPECT_TRUE(std::isnan(file.read("value")[0]));
  EXPECT_EQ(file.read("value")[2], 80.5);
}

TEST(ResumableFile, EndsWithTheSameBytesHoweverItWasWritten) {
  const support::TemporaryFolder folder;
  {
    ResumableFile file(folder / "one.nc", layout());
    for (std::size_t x = 0; x < 4; ++x) put(file, x, static_cast<double>(x));
    file.commit();
  }
  for (const std::size_t x : {3U, 0U, 2U, 1U})
    ResumableFile(folder / "two.nc", layout()).write("done", {.start = {x}, .count = {1}}, std::vector<double>{1.0});
  for (const std::size_t x : {1U, 2U, 0U, 3U}) {
    ResumableFile file(folder / "two.nc", layout());
    put(file, x, static_cast<double>(x));
    if (x == 3) file.commit();
  }
  EXPECT_EQ(bytes(folder / "one.nc"), bytes(folder / "two.nc"));
  EXPECT_TRUE(ResumableFile::is_finished(folder / "two.nc", layout()));
}

std::string complaint_about_finished(const std::filesystem::path& path, const Layout& wanted) {
  try {
    (void)ResumableFile::is_finished(path, wanted);
  } catch (const FileError& e) {
    return e.what();
  }
  return "none";
}

TEST(ResumableFile, RefusesANameThatSomethingElseHas) {
  const support::TemporaryFolder folder;
  {
    ResumableFile file(folder / "f.nc", layout("first", 1000));
    file.commit();
  }
  EXPECT_NE(complaint_about_finished(folder / "f.nc", layout("second", 1000)).find("purpose: stands there already"), std::string::npos);
  EXPECT_NE(complaint(folder / "f.nc", layout("first", 1000)).find("stands there already"), std::string::npos);
  std::filesystem::resize_file(folder / "f.nc", 2000);
  EXPECT_NE(complaint_about_finished(folder / "f.nc", layout("first", 1000)).find("truncated"), std::string::npos);
  std::filesystem::create_directory(folder / "folder.nc");
  EXPECT_NE(complaint_about_finished(folder / "folder.nc", layout()).find("cannot be read"), std::string::npos);
  std::ofstream(folder / "thesis.txt") << "all of it";
  EXPECT_NE(complaint_about_finished(folder / "thesis.txt", layout()).find("not a whole NetCDF file"), std::string::npos);
  EXPECT_FALSE(ResumableFile::is_finished(folder / "new.nc", layout()));
}

TEST(ResumableFile, HasItsWholeSizeFromTheBeginning) {
  const support::TemporaryFolder folder;
  ResumableFile file(folder / "f.nc", layout("first", 10'000));
  const auto size = std::filesystem::file_size(folder / "f.nc.partial");
  EXPECT_GT(size, 80'000U);
  for (std::size_t x = 0; x < 10'000; ++x) put(file, x, 1.0);
  file.flush();
  EXPECT_EQ(std::filesystem::file_size(folder / "f.nc.partial"), size);
}

TEST(ResumableFile, RefusesToGoOnWithWhatWasBegunForAnotherPurposeOrShape) {
  const support::TemporaryFolder folder;
  { const ResumableFile file(folder / "f.nc", layout()); }
  EXPECT_TRUE(support::has_line(complaint(folder / "f.nc", layout("second")), {"f.nc.partial", "purpose"}));
  EXPECT_TRUE(support::has_line(complaint(folder / "f.nc", layout("first", 5)), {"f.nc.partial", "begun"}));
  EXPECT_EQ(complaint(folder / "f.nc", layout()), "none");
}

TEST(ResumableFile, RefusesASecondWriter) {
  const support::TemporaryFolder folder;
  const ResumableFile file(folder / "f.nc", layout());
  EXPECT_NE(complaint(folder / "f.nc", layout()).find("is writing it"), std::string::npos);
}

TEST(ResumableFile, RefusesASecondWriterWhileTheFirstStillFillsItsDraft) {
  const support::TemporaryFolder folder;
  const std::filesystem::path draft = folder / "f.nc.partial.new";
  const int other = open(draft.c_str(), O_RDWR | O_CREAT, 0666);
  struct flock whole {};
  whole.l_type = F_WRLCK;
  ASSERT_EQ(fcntl(other, F_OFD_SETLK, &whole), 0);  // belongs to the descriptor: as good as another process's
  EXPECT_NE(complaint(folder / "f.nc", layout()).find("is writing it"), std::string::npos);
  EXPECT_TRUE(std::filesystem::exists(draft)) << "the other's draft was taken away";
  close(other);
  EXPECT_EQ(complaint(folder / "f.nc", layout()), "none") << "a draft that a killed process left is in the way";
}

TEST(ResumableFile, RefusesATruncatedFileAndANameInNoFolder) {
  const support::TemporaryFolder folder;
  { const ResumableFile file(folder / "f.nc", layout("first", 1000)); }
  std::filesystem::resize_file(folder / "f.nc.partial", 2000);
  EXPECT_NE(complaint(folder / "f.nc", layout("first", 1000)).find("truncated"), std::string::npos);
  EXPECT_NE(complaint(folder / "no/f.nc", layout()).find("cannot be written"), std::string::npos);
}

}  // namespace
}  // namespace earshot::netcdf
