#include "sim/netcdf/writer.hpp"

#include <gtest/gtest.h>
#include <netcdf.h>

#include <cstdlib>
#include <fstream>
#include <string>
#include <vector>

#include "sim/netcdf/reader.hpp"
#include "tests/support/file_size_limit.hpp"
#include "tests/support/temporary_folder.hpp"

namespace earshot::netcdf {
namespace {

void fill(Writer& file, std::size_t values) {
  file.dimension("range", values);
  file.variable("range", Type::kDouble, {"range"}, {{"units", "m"}});
  file.variable("tl", Type::kFloat, {"range"}, {{"units", "dB"}});
  file.attribute("tl", "_FillValue", -999.0);
  file.write("range", std::vector<double>(values, 2.5));
  file.write("tl", std::vector<float>(values, 80.25F));
}

TEST(NetcdfWriter, WritesWhatTheReaderReads) {
  const support::TemporaryFolder folder;
  Writer file(folder / "f.nc");
  fill(file, 5);
  file.write("range", Block{.start = {1}, .count = {2}}, std::vector<double>{7.0, -1.0});
  file.commit();
  const Reader back(folder / "f.nc");
  EXPECT_EQ(back.read("range"), (std::vector<double>{2.5, 7.0, -1.0, 2.5, 2.5}));
  EXPECT_EQ(back.read("tl"), std::vector<double>(5, 80.25));
  EXPECT_EQ(back.text_attribute("tl", "units"), "dB");
}

/// Lengths of a compressed variable's chunks, from the library itself.
std::vector<std::size_t> chunks_of(const std::vector<std::size_t>& lengths) {
  const support::TemporaryFolder folder;
  Writer file(folder / "f.nc");
  std::vector<std::string> names;
  for (const std::size_t length : lengths) file.dimension(names.emplace_back("d" + std::to_string(names.size())), length);
  file.variable("tl", Type::kFloat, names, {});
  file.compress("tl");
  file.commit();
  int id = -1;
  int storage = -1;
  std::vector<std::size_t> chunk(lengths.size());
  EXPECT_EQ(nc_open((folder / "f.nc").c_str(), NC_NOWRITE, &id), NC_NOERR);
  EXPECT_EQ(nc_inq_var_chunking(id, 0, &storage, chunk.data()), NC_NOERR);
  nc_close(id);
  return chunk;
}

TEST(NetcdfWriter, CompressesInChunksOf64KibibytesThatHoldWholeRows) {
  EXPECT_EQ(chunks_of({8000, 300}), (std::vector<std::size_t>{54, 300}));       // 54 x 300 x 4 bytes = 64 800
  EXPECT_EQ(chunks_of({72, 2000, 1}), (std::vector<std::size_t>{8, 2000, 1}));  // 8 bearings
  EXPECT_EQ(chunks_of({3, 20'000}), (std::vector<std::size_t>{1, 16'384}));     // a row alone is longer
  EXPECT_EQ(chunks_of({3, 2}), (std::vector<std::size_t>{3, 2}));
}

TEST(NetcdfWriter, LeavesTheOldFileAndNothingElseWhenNotCommitted) {
  const support::TemporaryFolder folder;
  std::ofstream(folder / "f.nc") << "old";
  {
    Writer file(folder / "f.nc");
    fill(file, 5);
  }
  std::string content;
  std::ifstream(folder / "f.nc") >> content;
  EXPECT_EQ(content, "old");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1);
}

TEST(NetcdfWriter, RefusesAFolderThatIsNotThereAndANumberOfValuesThatDoesNotFit) {
  const support::TemporaryFolder folder;
  EXPECT_THROW(Writer(folder / "none/f.nc"), host::BadInput);
  Writer file(folder / "f.nc");
  file.dimension("range", 5);
  file.variable("range", Type::kDouble, {"range"}, {});
  EXPECT_THROW(file.write("range", std::vector<double>(4)), FileError);
}

/// @return what is complained of; empty when the file was written
std::string complaint_within(const std::filesystem::path& path, std::size_t values, rlim_t bytes) {
  const support::FileSizeLimit limit(bytes);
  try {
    Writer file(path);
    fill(file, values);
    file.commit();
  } catch (const FileError& e) {
    return e.what();
  }
  return {};
}

TEST(NetcdfWriter, SaysThatTheDiskIsFullAndLeavesNothingBehindWhereverItFills) {
  const support::TemporaryFolder folder;
  for (const std::size_t values : {10U, 20'000U}) {
    int written = 0;
    int refused = 0;
    for (rlim_t bytes = 50; bytes < 20 * values + 20'000; bytes += 50 + 2 * values) {
      const std::string complaint = complaint_within(folder / "f.nc", values, bytes);
      if (complaint.empty()) {
        ++written;
        EXPECT_EQ(Reader(folder / "f.nc").read("tl"), std::vector<double>(values, 80.25)) << bytes;
        std::filesystem::remove(folder / "f.nc");
      } else {
        ++refused;
        EXPECT_TRUE(complaint.ends_with("cannot be written (File too large)")) << bytes << ": " << complaint;
      }
      EXPECT_TRUE(std::filesystem::is_empty(folder.path())) << bytes;
    }
    EXPECT_GT(written, 0);
    EXPECT_GT(refused, 3);
  }
}

TEST(NetcdfWriter, LetsAProgramEndInPeaceAfterAFullDisk) {
  const support::TemporaryFolder folder;
  testing::FLAGS_gtest_death_test_style = "threadsafe";  // a process of its own, in which the library has not been used yet
  EXPECT_EXIT(
      {
        for (rlim_t bytes = 50; bytes < 20'000; bytes += 150) (void)complaint_within(folder / "f.nc", 10, bytes);
        std::exit(2);
      },
      testing::ExitedWithCode(2), "");
}

TEST(NetcdfWriter, SaysThatItCannotTakeItsNameAndLeavesNothingBehind) {
  const support::TemporaryFolder folder;
  std::filesystem::create_directories(folder / "f.nc/in the way");
  EXPECT_THROW(Writer(folder / "f.nc"), host::BadInput);
  {
    Writer file(folder / "g.nc");
    fill(file, 5);
    std::filesystem::create_directories(folder / "g.nc/in the way by now");
    EXPECT_THROW(file.commit(), host::BadInput);
  }
  std::filesystem::remove_all(folder / "g.nc");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1);
}

}  // namespace
}  // namespace earshot::netcdf
