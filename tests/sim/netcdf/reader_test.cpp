#include "sim/netcdf/reader.hpp"

#include <gtest/gtest.h>
#include <netcdf.h>
#ifdef __SANITIZE_ADDRESS__
#include <sanitizer/lsan_interface.h>
#endif

#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <random>
#include <string>
#include <system_error>
#include <vector>

#include "sim/netcdf/library_exit.hpp"
#include "tests/support/temporary_folder.hpp"

namespace earshot::netcdf {
namespace {

/// v(y, x) = 10 y + x as packed shorts (0.5 v + 100), one of them missing.
void write_packed(const std::filesystem::path& path, int format) {
  leave_hdf5_alone_at_exit();
  int file = -1;
  std::array<int, 2> dims{};
  int id = -1;
  ASSERT_EQ(nc_create(path.c_str(), NC_CLOBBER | format, &file), NC_NOERR);
  ASSERT_EQ(nc_def_dim(file, "y", 4, dims.data()), NC_NOERR);
  ASSERT_EQ(nc_def_dim(file, "x", 10, &dims[1]), NC_NOERR);
  ASSERT_EQ(nc_def_var(file, "v", NC_SHORT, 2, dims.data(), &id), NC_NOERR);
  const short fill = -999;
  const double scale = 0.5;
  const double offset = 100.0;
  ASSERT_EQ(nc_put_att_short(file, id, "_FillValue", NC_SHORT, 1, &fill), NC_NOERR);
  ASSERT_EQ(nc_put_att_double(file, id, "scale_factor", NC_DOUBLE, 1, &scale), NC_NOERR);
  ASSERT_EQ(nc_put_att_double(file, id, "add_offset", NC_DOUBLE, 1, &offset), NC_NOERR);
  ASSERT_EQ(nc_put_att_text(file, id, "units", 1, "m"), NC_NOERR);
  ASSERT_EQ(nc_enddef(file), NC_NOERR);
  std::vector<short> values;
  for (int y = 0; y < 4; ++y) {
    for (int x = 0; x < 10; ++x) values.push_back(static_cast<short>(10 * y + x));
  }
  values[13] = fill;
  ASSERT_EQ(nc_put_var_short(file, id, values.data()), NC_NOERR);
  ASSERT_EQ(nc_close(file), NC_NOERR);
}

std::string message_of(const auto& action) {
  try {
    action();
  } catch (const host::BadInput& e) {
    return e.what();
  }
  return "no error";
}

TEST(NetcdfReader, UnpacksValuesAndTurnsMissingOnesIntoNan) {
  const support::TemporaryFolder folder;
  for (const int format : {0, NC_NETCDF4}) {
    write_packed(folder / "v.nc", format);
    const Reader file(folder / "v.nc");
    EXPECT_EQ(file.dimensions_of("v"), (std::vector<std::string>{"y", "x"}));
    EXPECT_EQ(file.text_attribute("v", "units"), "m");
    const std::vector<double> all = file.read("v");
    ASSERT_EQ(all.size(), 40U);
    EXPECT_EQ(all[27], 100.0 + 27 * 0.5);
    EXPECT_TRUE(std::isnan(all[13]));
    EXPECT_EQ(file.read("v", {.start = {2, 3}, .count = {2, 2}}), (std::vector<double>{111.5, 112.0, 116.5, 117.0}));
  }
}

TEST(NetcdfReader, NamesFileAndVariableInItsErrors) {
  const support::TemporaryFolder folder;
  const std::string path = (folder / "v.nc").string();
  write_packed(path, NC_NETCDF4);
  const Reader file(path);
  EXPECT_EQ(message_of([&] { (void)file.read("salinity"); }), path + ": salinity: no such variable");
  EXPECT_EQ(message_of([&] { (void)file.read("v", {.start = {0, 8}, .count = {1, 3}}); }), path + ": v: is smaller than asked for");
  EXPECT_EQ(message_of([&] { (void)file.read("v", {.start = {0}, .count = {1}}); }), path + ": v: has another number of dimensions");
}

TEST(NetcdfReader, RefusesWhatIsMissingOrNoNetcdf) {
  const support::TemporaryFolder folder;
  EXPECT_NE(message_of([&] { const Reader file(folder / "none.nc"); }).find("none.nc: no such file"), std::string::npos);
  EXPECT_NE(message_of([&] { const Reader file(folder.path()); }).find("cannot be read"), std::string::npos);
  std::ofstream(folder / "text.nc") << "lat,lon,elevation\n1,2,3\n";
  EXPECT_NE(message_of([&] { const Reader file(folder / "text.nc"); }).find("text.nc: not a whole NetCDF file"), std::string::npos);
}

TEST(NetcdfReader, RefusesEveryTruncation) {
  const support::TemporaryFolder folder;
  for (const int format : {0, NC_64BIT_OFFSET, NC_64BIT_DATA, NC_NETCDF4}) {
    write_packed(folder / "whole.nc", format);
    const auto size = std::filesystem::file_size(folder / "whole.nc");
    for (std::uintmax_t length = 0; length < size; length += length + 16 < size ? 211 : 1) {
      std::filesystem::copy_file(folder / "whole.nc", folder / "cut.nc", std::filesystem::copy_options::overwrite_existing);
      std::filesystem::resize_file(folder / "cut.nc", length);
      EXPECT_THROW((void)Reader(folder / "cut.nc").read("v"), FileError) << "format " << format << ", " << length << " of " << size;
    }
  }
}

TEST(NetcdfReader, RefusesALongClassicFileCutWhereTheLibraryReadsZeros) {
  const support::TemporaryFolder folder;
  const std::vector<float> ones(20'000, 1.0F);
  leave_hdf5_alone_at_exit();
  int file = -1;
  int x = -1;
  int id = -1;
  ASSERT_EQ(nc_create((folder / "long.nc").c_str(), NC_CLOBBER, &file), NC_NOERR);
  ASSERT_EQ(nc_def_dim(file, "x", ones.size(), &x), NC_NOERR);
  ASSERT_EQ(nc_def_var(file, "v", NC_FLOAT, 1, &x, &id), NC_NOERR);
  ASSERT_EQ(nc_enddef(file), NC_NOERR);
  ASSERT_EQ(nc_put_var_float(file, id, ones.data()), NC_NOERR);
  ASSERT_EQ(nc_close(file), NC_NOERR);
  EXPECT_EQ(Reader(folder / "long.nc").read("v").back(), 1.0);
  for (const std::uintmax_t length : {79'000U, 40'000U, 10'000U, 1000U}) {
    std::filesystem::resize_file(folder / "long.nc", length);
    EXPECT_THROW(Reader(folder / "long.nc"), FileError) << length;
  }
}

/// Written by netCDF4-python 1.7: compressed chunks, and a text attribute that is a string as h5netcdf writes all of them.
const std::filesystem::path kStrings = std::filesystem::path(EARSHOT_SOURCE_DIR) / "tests/sim/netcdf/reference/strings.nc";

TEST(NetcdfReader, ReadsATextThatIsAString) {
  EXPECT_EQ(Reader(kStrings).text_attribute("elevation", "long_name"), "elevation");
}

/// Damage that a child survives by chance may crash its parent: what a damaged file overwrites in memory is another thing each time.
TEST(NetcdfReader, KeepsNoNetcdf4FileOpen) {
  const auto is_open = [] {
    for (const auto& entry : std::filesystem::directory_iterator("/proc/self/fd")) {
      std::error_code gone;
      if (std::filesystem::read_symlink(entry.path(), gone) == std::filesystem::canonical(kStrings)) return true;
    }
    return false;
  };
  const Reader file(kStrings);
  EXPECT_FALSE(is_open());
  (void)file.read("elevation");
  EXPECT_FALSE(is_open());
  const std::ifstream opened(kStrings);
  EXPECT_TRUE(is_open()) << "this test sees no open file";
}

TEST(NetcdfReader, SurvivesDamageOfAllKinds) {
#ifdef __SANITIZE_ADDRESS__
  const __lsan::ScopedDisabler the_library_leaks_what_it_read_of_a_header_it_refuses;
#endif
  const support::TemporaryFolder folder;
  std::ifstream whole(kStrings, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(whole), {}};
  for (std::uint32_t seed = 0; seed < 550; ++seed) {
    std::mt19937 random(seed);
    std::string damaged = bytes;
    for (std::uint32_t left = 1 + random() % 8; left > 0; --left) {
      const std::size_t at = random() % damaged.size();
      damaged[at] = static_cast<char>(random() & 0xFFU);
    }
    std::ofstream(folder / "damaged.nc", std::ios::binary) << damaged;
    try {
      const Reader file(folder / "damaged.nc");
      for (const char* variable : {"lat", "lon", "elevation"}) {
        (void)file.text_attribute(variable, "units");
        (void)file.read(variable);  // may still read
      }
    } catch (const FileError& e) {
      const std::string said = e.what();
      EXPECT_EQ(said.find((folder / "damaged.nc").string() + ": "), 0U) << said;
    }
  }
}

TEST(NetcdfReader, SurvivesADamagedHeader) {
#ifdef __SANITIZE_ADDRESS__
  const __lsan::ScopedDisabler the_library_leaks_what_it_read_of_a_header_it_refuses;
#endif
  const support::TemporaryFolder folder;
  for (const int format : {0, NC_NETCDF4}) {
    write_packed(folder / "whole.nc", format);
    std::ifstream whole(folder / "whole.nc", std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(whole), {}};
    for (std::size_t at = 0; at < std::min<std::size_t>(bytes.size(), 200); at += 3) {
      std::string damaged = bytes;
      damaged[at] = static_cast<char>(damaged[at] ^ 0x55);
      std::ofstream(folder / "damaged.nc", std::ios::binary) << damaged;
      try {
        (void)Reader(folder / "damaged.nc").read("v");  // may still read: not every byte of a header carries meaning
      } catch (const FileError& e) {
        EXPECT_NE(std::string(e.what()).find("damaged.nc"), std::string::npos);
      }
    }
  }
}

}  // namespace
}  // namespace earshot::netcdf
