#include "sim/netcdf/classic_size.hpp"

#include <gtest/gtest.h>
#include <netcdf.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

#include "sim/netcdf/library_exit.hpp"
#include "tests/support/bytes_read.hpp"
#include "tests/support/temporary_folder.hpp"

namespace earshot::netcdf {
namespace {

/// Fixed and record variables of odd sizes, so that padding counts.
void write_classic(const std::filesystem::path& path, int format, int record_variables) {
  leave_hdf5_alone_at_exit();
  int file = -1;
  int x = -1;
  int time = -1;
  int fixed = -1;
  ASSERT_EQ(nc_create(path.c_str(), NC_CLOBBER | format, &file), NC_NOERR);
  ASSERT_EQ(nc_def_dim(file, "x", 7, &x), NC_NOERR);
  ASSERT_EQ(nc_def_dim(file, "time", NC_UNLIMITED, &time), NC_NOERR);
  ASSERT_EQ(nc_put_att_text(file, NC_GLOBAL, "title", 5, "a sea"), NC_NOERR);
  ASSERT_EQ(nc_def_var(file, "fixed", NC_SHORT, 1, &x, &fixed), NC_NOERR);
  std::vector<int> records;
  const std::array<int, 2> shape = {time, x};
  for (int i = 0; i < record_variables; ++i) {
    ASSERT_EQ(nc_def_var(file, i == 0 ? "r0" : "r1", NC_SHORT, 2, shape.data(), &records.emplace_back()), NC_NOERR);
  }
  ASSERT_EQ(nc_enddef(file), NC_NOERR);
  const std::array<short, 7> values = {1, 2, 3, 4, 5, 6, 7};
  ASSERT_EQ(nc_put_var_short(file, fixed, values.data()), NC_NOERR);
  for (std::size_t record = 0; record < 3; ++record) {
    const std::array<std::size_t, 2> start = {record, 0};
    const std::array<std::size_t, 2> count = {1, 7};
    for (const int id : records) ASSERT_EQ(nc_put_vara_short(file, id, start.data(), count.data(), values.data()), NC_NOERR);
  }
  ASSERT_EQ(nc_close(file), NC_NOERR);
}

TEST(ClassicSize, IsTheSizeOfTheFileThatTheLibraryWritesButForItsPadding) {
  const support::TemporaryFolder folder;
  for (const int format : {0, NC_64BIT_OFFSET, NC_64BIT_DATA}) {
    for (const int record_variables : {0, 1, 2}) {
      const auto path = folder / "classic.nc";
      write_classic(path, format, record_variables);
      const auto size = classic_size(path);
      ASSERT_TRUE(size.has_value());
      const auto on_disk = std::filesystem::file_size(path);
      EXPECT_LE(*size, on_disk) << "format " << format << ", record variables " << record_variables;
      EXPECT_GE(*size + 3, on_disk) << "format " << format << ", record variables " << record_variables;
    }
  }
}

/// A header of CDF-5 with one dimension and one variable of it, told by hand from the specification; big-endian.
std::string header_of_rank(std::uint64_t dimension, std::uint64_t rank) {
  std::string bytes = "CDF\x05";
  const auto append = [&bytes](std::uint64_t number, int size) {
    for (int i = size - 1; i >= 0; --i) bytes.push_back(static_cast<char>(number >> (8 * i)));
  };
  append(0, 8);                                                                                         // records
  append(10, 4), append(1, 8), append(1, 8), bytes += std::string("x\0\0\0", 4), append(dimension, 8);  // one dimension, x
  append(0, 4), append(0, 8);                                                                           // no attributes
  append(11, 4), append(1, 8), append(1, 8), bytes += std::string("v\0\0\0", 4), append(rank, 8);       // one variable, v
  for (std::uint64_t i = 0; i < std::min<std::uint64_t>(rank, 4); ++i) append(0, 8);                    // each of its dimensions is x
  append(0, 4), append(0, 8);                                                                           // no attributes
  append(4, 4), append(0, 8), append(bytes.size() + 8, 8);                                              // of NC_INT; where its values begin
  return bytes;
}

TEST(ClassicSize, IsUnknownWhereTheProductOfTheDimensionsRunsOver) {
  const support::TemporaryFolder folder;
  const auto size_of = [&folder](const std::string& header) {
    std::ofstream(folder / "v.nc", std::ios::binary) << header;
    return classic_size(folder / "v.nc");
  };
  const std::string small = header_of_rank(1000, 2);
  EXPECT_EQ(size_of(small), small.size() + 4'000'000);
  EXPECT_EQ(size_of(header_of_rank(std::uint64_t{1} << 31U, 2)), std::nullopt) << "2^62 values of 4 bytes: 2^64 bytes are 0";
  EXPECT_EQ(size_of(header_of_rank(std::uint64_t{1} << 32U, 2)), std::nullopt) << "2^64 values are 0";
}

TEST(ClassicSize, ReadsAVastFileNotToItsEndForAVariableOfTooManyDimensions) {
  const support::TemporaryFolder folder;
  const std::string header = header_of_rank(1, std::uint64_t{1} << 40U);
  std::ofstream(folder / "v.nc", std::ios::binary) << header.substr(0, header.find('v') + 12);  // up to the number of dimensions
  std::filesystem::resize_file(folder / "v.nc", std::uintmax_t{4} << 30U);  // sparse: all of its further dimensions are x
  const std::uint64_t before = support::bytes_read();
  EXPECT_EQ(classic_size(folder / "v.nc"), std::nullopt);
  EXPECT_LT(support::bytes_read() - before, 1U << 20U) << "of 4 GiB";
}

}  // namespace
}  // namespace earshot::netcdf
