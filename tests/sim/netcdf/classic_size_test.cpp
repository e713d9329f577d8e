#include "sim/netcdf/classic_size.hpp"

#include <gtest/gtest.h>
#include <netcdf.h>

#include <array>
#include <vector>

#include "sim/netcdf/library_exit.hpp"
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

}  // namespace
}  // namespace earshot::netcdf
