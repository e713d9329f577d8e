#include "sim/field_library/reader.hpp"

#include <gtest/gtest.h>

#include <netcdf.h>

#include <array>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "sim/field_library/library_file.hpp"
#include "sim/field_library/store.hpp"
#include "sim/netcdf/classic_size.hpp"
#include "sim/netcdf/file_error.hpp"
#include "tests/support/bytes_read.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text/tells.hpp"

namespace earshot::field_library {
namespace {

/// Three positions, the middle one on land; four bearings, ranges 100 m and 200 m, depths 10 m and 50 m. Nothing is computed: the loss at
/// position p, bearing b, range r, depth d is 100 p + 10 b + r + 5 d (their indices).
class FieldLibraryInMemory : public testing::Test {
 protected:
  [[nodiscard]] static std::vector<float> loss_db(std::size_t position) {
    std::vector<float> values;
    for (std::size_t b = 0; b < 4; ++b)
      for (std::size_t r = 0; r < 2; ++r)
        for (std::size_t d = 0; d < 2; ++d) values.push_back(static_cast<float>(100 * position + 10 * b + r + 5 * d));
    values.back() = std::numeric_limits<float>::quiet_NaN();  // west, 200 m, 50 m: below the sea floor
    return values;
  }

  /// @param change  what is to be otherwise at the last position
  void write(const std::function<void(std::vector<float>&)>& change = [](auto&) {}) {
    std::filesystem::remove(path_);
    LibraryStore store(path_, plan_);
    store.mark(1, PositionState::kNoWater);
    store.write(0, loss_db(0));
    std::vector<float> last = loss_db(2);
    change(last);
    store.write(2, last);
    store.commit();
  }

  void overwrite(const char* variable, std::size_t index, double value) const {
    int file = -1;
    int id = -1;
    ASSERT_EQ(nc_open(path_.c_str(), NC_WRITE, &file), NC_NOERR);
    ASSERT_EQ(nc_inq_varid(file, variable, &id), NC_NOERR);
    ASSERT_EQ(nc_put_var1_double(file, id, &index, &value), NC_NOERR);
    ASSERT_EQ(nc_close(file), NC_NOERR);
  }

  /// What is said of the library, without the file's name; empty when it is read.
  [[nodiscard]] std::string complaint() const {
    try {
      const FieldLibrary library(path_);
    } catch (const netcdf::FileError& e) {
      return std::string(e.what()).substr(path_.string().size());
    }
    return {};
  }

  support::TemporaryFolder folder_;
  std::filesystem::path path_ = folder_ / "library.nc";
  LibraryPlan plan_{.name = "three",
                    .environment = {},
                    .positions = {{Meters{0.0}, Meters{0.0}}, {Meters{0.0}, Meters{1000.0}}, {Meters{5000.0}, Meters{0.0}}},
                    .centre = Centre::kSource,
                    .fan = {.bearings = 4,
                            .radial = {.source_depth = Meters{30.0},
                                       .depth_m = {10.0, 50.0},
                                       .range_step = Meters{100.0},
                                       .ranges = 2,
                                       .band = {Hertz{20.0}, Hertz{20.0}}}},
                    .file_crc32 = 1};
};

TEST_F(FieldLibraryInMemory, HoldsThePositionsInTheWaterOnly) {
  write();
  const FieldLibrary library(path_);
  ASSERT_EQ(library.fans().size(), 2U);
  EXPECT_EQ(library.fans()[1].centre, (NorthEast{Meters{5000.0}, Meters{0.0}}));
  EXPECT_EQ(library.fans()[1].depth_m, (std::vector<double>{10.0, 50.0}));
  EXPECT_EQ(library.centre_depth(), Meters{30.0});
  EXPECT_EQ(library.frequency_hz().size(), 1U);
  EXPECT_EQ(library.frequency_hz().front(), 20.0);
  EXPECT_EQ(library.fans()[1].at(2, 1, 0), 221.0F);  // position 2, bearing 2, range 1, depth 0
}

TEST_F(FieldLibraryInMemory, KnowsWhatStandsInTheCentre) {
  plan_.centre = Centre::kHydrophone;
  write();
  EXPECT_EQ(FieldLibrary(path_).centre(), Centre::kHydrophone);
}

TEST_F(FieldLibraryInMemory, RefusesAnUnfinishedLibraryAndOtherFiles) {
  {
    LibraryStore store(path_, plan_);
    store.write(0, loss_db(0));
  }
  EXPECT_THROW(FieldLibrary(path_.string() + ".partial"), netcdf::FileError);
  EXPECT_THROW(FieldLibrary(folder_ / "none.nc"), netcdf::FileError);
}

TEST_F(FieldLibraryInMemory, RefusesALossThatCannotBe) {
  const float infinite = std::numeric_limits<float>::infinity();
  for (const auto& [loss, said] : {std::pair{infinite, "inf"}, {-infinite, "-inf"}, {1e30F, "1e+30"}, {-61.0F, "-61"}, {301.0F, "301"}}) {
    write([value = loss](std::vector<float>& at_position_2) { at_position_2[4 * 2 + 2 * 1 + 0] = value; });  // bearing 2, range 1, depth 0
    EXPECT_TRUE(support::tells(
        complaint(), {"transmission_loss[2", "2", "1", "0]", std::string(said), "at least -60", "at most 300", "missing", "_FillValue"}));
  }
}

TEST_F(FieldLibraryInMemory, RefusesAMissingValueAboveOneThatIsThere) {
  write([](std::vector<float>& at_position_2) { at_position_2[4 * 3 + 0] = std::numeric_limits<float>::quiet_NaN(); });
  EXPECT_TRUE(support::tells(complaint(), {"transmission_loss[2", "3", "0", "0]", "nan"}));
}

TEST_F(FieldLibraryInMemory, RefusesMissingValuesAlone) {
  plan_.positions.resize(1);
  {
    LibraryStore store(path_, plan_);
    store.write(0, std::vector<float>(16, std::numeric_limits<float>::quiet_NaN()));
    store.commit();
  }
  EXPECT_TRUE(support::tells(complaint(), {"transmission_loss", "values", "missing"}));
}

TEST_F(FieldLibraryInMemory, RefusesAnAxisThatCannotBe) {
  write();
  const std::filesystem::path whole = folder_ / "whole.nc";
  std::filesystem::rename(path_, whole);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  struct Case {
    const char* variable;
    std::size_t index;
    double value;
    const char* complaint;
  };
  for (const Case& c :
       std::vector<Case>{{"range", 1, 350.0, "range[1] = 350: must be 200"},
                         {"range", 0, nan, "range[0] = nan: must be a finite number"},
                         {"range", 0, 0.0, "range[0] = 0: must be a finite number of at least 0.01"},
                         {"depth", 1, 10.0, "depth: must increase"},
                         {"depth", 0, -5.0, "depth[0] = -5: must be a finite number above 0 and at most 12000"},
                         {"position_north", 2, 1e30, "position_north[2] = 1e+30: must be a finite number of at least -1000000"},
                         {"position_state", 0, 7.0, "position_state[0] = 7: must be a finite number of at least 0 and at most 2"},
                         {"position_depth", 0, nan, "position_depth[0] = nan: must be a finite number above 0"},
                         {"frequency", 0, 0.0, "frequency[0] = 0: must be a finite number of at least 1"}}) {
    std::filesystem::copy_file(whole, path_, std::filesystem::copy_options::overwrite_existing);
    overwrite(c.variable, c.index, c.value);
    EXPECT_NE(complaint().find(std::string(": ") + c.complaint), std::string::npos) << complaint();
  }
}

using FieldLibraryHeader = FieldLibraryInMemory;

constexpr std::uintmax_t kFourGiB = std::uintmax_t{4} << 30U;

/// What is said of the file by its header alone, without the file's name; empty when it may be read.
std::string complaint_of_header(const std::filesystem::path& path) {
  const std::uint64_t before = support::bytes_read();
  std::string complaint;
  try {
    require_library(path);
  } catch (const netcdf::FileError& e) {
    complaint = std::string(e.what()).substr(path.string().size());
  }
  EXPECT_LT(support::bytes_read() - before, 1U << 20U) << "of " << std::filesystem::file_size(path);
  return complaint;
}

/// A library whose fields are a hole, in a file as large as its header promises.
void make_sparse(const std::filesystem::path& path, const std::array<std::size_t, 4>& shape) {
  struct Axis {
    const char* name;
    std::size_t dimension;
    double first, step;
  };
  const std::array<Axis, 5> axes = {
      {{"position_state", 0, 0, 0}, {"position_north", 0, 0, 0}, {"position_east", 0, 0, 0}, {"range", 2, 1, 1}, {"depth", 3, 1, 1}}};
  int file = -1;
  std::array<int, 4> dimensions{};
  std::array<int, 5> variables{};
  int loss = -1;
  ASSERT_EQ(nc_create(path.c_str(), NC_64BIT_DATA | NC_CLOBBER, &file), NC_NOERR);
  ASSERT_EQ(nc_set_fill(file, NC_NOFILL, nullptr), NC_NOERR);
  const std::array<const char*, 4> names = {"position", "bearing", "range", "depth"};
  for (std::size_t i = 0; i < names.size(); ++i) ASSERT_EQ(nc_def_dim(file, names[i], shape[i], &dimensions[i]), NC_NOERR);
  for (std::size_t i = 0; i < axes.size(); ++i)
    ASSERT_EQ(nc_def_var(file, axes[i].name, NC_DOUBLE, 1, &dimensions[axes[i].dimension], &variables[i]), NC_NOERR);
  ASSERT_EQ(nc_def_var(file, "transmission_loss", NC_FLOAT, 4, dimensions.data(), &loss), NC_NOERR);
  ASSERT_EQ(nc_enddef(file), NC_NOERR);
  for (std::size_t i = 0; i < axes.size(); ++i) {
    std::vector<double> values;
    for (std::size_t k = 0; k < shape[axes[i].dimension]; ++k) values.push_back(axes[i].first + static_cast<double>(k) * axes[i].step);
    ASSERT_EQ(nc_put_var_double(file, variables[i], values.data()), NC_NOERR);
  }
  ASSERT_EQ(nc_close(file), NC_NOERR);
  std::filesystem::resize_file(path, netcdf::classic_size(path).value());
}

TEST_F(FieldLibraryHeader, IsEnoughToRefuseFourGigabytesOfNothing) {
  std::ofstream{path_}.close();
  std::filesystem::resize_file(path_, kFourGiB);
  EXPECT_NE(complaint_of_header(path_).find("not a whole NetCDF file"), std::string::npos);
}

TEST_F(FieldLibraryHeader, IsEnoughToRefuseALibraryWithFourGigabytesBehindIt) {
  write();
  EXPECT_EQ(complaint_of_header(path_), "");
  std::filesystem::resize_file(path_, kFourGiB);
  EXPECT_TRUE(support::tells(complaint_of_header(path_), {"4294967296 bytes", "header", "promises"}));
  EXPECT_TRUE(support::tells(complaint(), {"4294967296 bytes", "header", "promises"}));
}

TEST_F(FieldLibraryHeader, IsEnoughToRefuseMoreThanALibraryCanHold) {
  const std::string too_large = ": transmission_loss: is larger than a library can be: 1 million positions of 64 million values each";
  make_sparse(path_, {1, 1000, 64, 1001});
  EXPECT_EQ(complaint_of_header(path_), too_large);
  make_sparse(path_, {1'000'001, 1, 1, 1});
  EXPECT_EQ(complaint_of_header(path_), too_large);
}

TEST_F(FieldLibraryHeader, IsEnoughToRefuseMoreThanIsKeptInMemory) {
  make_sparse(path_, {537, 1000, 1000, 1});
  EXPECT_TRUE(support::tells(complaint_of_header(path_), {"transmission_loss", "2 GiB", "kept"}));
  make_sparse(path_, {536, 1000, 1000, 1});
  EXPECT_EQ(complaint_of_header(path_), "");
}

TEST_F(FieldLibraryInMemory, OnTheDiskHasItsFansOneByOneAndWhatIsSaidOfAll) {
  plan_.environment.name = "hills";
  plan_.environment.source.level = Decibels{190.0};
  plan_.environment.noise_level = Decibels{90.0};
  write();
  const LibraryFile file(path_);
  EXPECT_EQ(file.text("environment"), "hills");
  EXPECT_EQ(file.text("title"), "Sound fields of a region: three");
  EXPECT_EQ(file.text("nothing"), std::nullopt);
  EXPECT_EQ(file.source_level(), Decibels{190.0});
  EXPECT_EQ(file.noise_level(), Decibels{90.0});
  EXPECT_EQ(file.east_m(), (std::vector<double>{0.0, 1000.0, 0.0}));
  EXPECT_EQ(file.fan(2).at(3, 0, 1), 235.0F);  // by the rule above
  EXPECT_FALSE(file.has_water(1));
  EXPECT_THROW((void)file.fan(1), netcdf::FileError);
  EXPECT_THROW((void)file.fan(3), netcdf::FileError);
}

}  // namespace
}  // namespace earshot::field_library
