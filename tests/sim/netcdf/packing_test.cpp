#include "sim/netcdf/packing.hpp"

#include <gtest/gtest.h>
#include <netcdf.h>

#include <cmath>
#include <functional>
#include <sstream>
#include <string>
#include <vector>

#include "sim/netcdf/library_exit.hpp"
#include "sim/netcdf/reader.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text/tells.hpp"

namespace earshot::netcdf {
namespace {

using Defined = std::function<void(int file, int variable)>;

/// What Reader gives of a variable of `type` with these stored numbers and attributes; "-" stands for none.
std::string read_back(nc_type type, const std::vector<double>& stored, const Defined& attributes) {
  const support::TemporaryFolder folder;
  leave_hdf5_alone_at_exit();
  int file = -1;
  int x = -1;
  int id = -1;
  EXPECT_EQ(nc_create((folder / "v.nc").c_str(), NC_CLOBBER | NC_NETCDF4, &file), NC_NOERR);
  EXPECT_EQ(nc_def_dim(file, "x", stored.size(), &x), NC_NOERR);
  EXPECT_EQ(nc_def_var(file, "v", type, 1, &x, &id), NC_NOERR);
  attributes(file, id);
  EXPECT_EQ(nc_enddef(file), NC_NOERR);
  EXPECT_EQ(nc_put_var_double(file, id, stored.data()), NC_NOERR);
  EXPECT_EQ(nc_close(file), NC_NOERR);
  std::string text;
  for (const double value : Reader(folder / "v.nc").read("v")) {
    std::ostringstream word;
    word << value;
    text += (text.empty() ? "" : " ") + (std::isnan(value) ? std::string("-") : word.str());
  }
  return text;
}

Defined numbers(const char* name, nc_type type, const std::vector<double>& values) {
  return [=](int file, int id) { EXPECT_EQ(nc_put_att_double(file, id, name, type, values.size(), values.data()), NC_NOERR); };
}

Defined text(const char* name, const std::string& value) {
  return [=](int file, int id) { EXPECT_EQ(nc_put_att_text(file, id, name, value.size(), value.data()), NC_NOERR); };
}

Defined all_of(const std::vector<Defined>& several) {
  return [=](int file, int id) {
    for (const Defined& one : several) one(file, id);
  };
}

TEST(NetcdfPacking, LeavesOutWhatLiesOutsideTheValidRange) {
  EXPECT_EQ(read_back(NC_SHORT, {-9999, -5001, -5000, 0, 100, 101}, numbers("valid_range", NC_SHORT, {-5000, 100})), "- - -5000 0 100 -");
  EXPECT_EQ(read_back(NC_FLOAT, {-9999, -5000, 0}, numbers("valid_min", NC_FLOAT, {-5000})), "- -5000 0");
  EXPECT_EQ(read_back(NC_FLOAT, {0, 9000, 9999}, numbers("valid_max", NC_FLOAT, {9000})), "0 9000 -");
}

TEST(NetcdfPacking, TakesALimitOfPackedNumbersForPackedOnesAndAFloatForValues) {
  const Defined packed = all_of({numbers("scale_factor", NC_DOUBLE, {0.5}), numbers("add_offset", NC_DOUBLE, {100})});
  EXPECT_EQ(read_back(NC_SHORT, {-1, 0, 10, 11}, all_of({packed, numbers("valid_range", NC_SHORT, {0, 10})})), "- 100 105 -");
  EXPECT_EQ(read_back(NC_SHORT, {-1, 0, 10, 11}, all_of({packed, numbers("valid_range", NC_DOUBLE, {100, 105})})), "- 100 105 -");
}

TEST(NetcdfPacking, LeavesOutEachOfSeveralMissingValues) {
  EXPECT_EQ(read_back(NC_INT, {-9999, 1, -32768, 2}, numbers("missing_value", NC_INT, {-9999, -32768})), "- 1 - 2");
  EXPECT_EQ(read_back(NC_INT, {-9999, 1, -1, 2}, all_of({numbers("_FillValue", NC_INT, {-1}), numbers("missing_value", NC_INT, {-9999})})),
            "- 1 - 2");
}

TEST(NetcdfPacking, KnowsAMissingFloatByADouble) {
  EXPECT_EQ(read_back(NC_FLOAT, {1e20, 0.1, 3}, numbers("missing_value", NC_DOUBLE, {1e20, 0.1})), "- - 3");
}

TEST(NetcdfPacking, LeavesOutWhatNobodyWroteWhereNoFillValueIsDeclared) {
  // The default fill values of the NetCDF User Guide.
  const Defined packed = all_of({numbers("scale_factor", NC_DOUBLE, {0.5}), numbers("add_offset", NC_DOUBLE, {100})});
  EXPECT_EQ(read_back(NC_SHORT, {-32767, 0, -32768}, packed), "- 100 -16284");
  EXPECT_EQ(read_back(NC_USHORT, {65535, 0}, packed), "- 100");
  EXPECT_EQ(read_back(NC_INT, {-2147483647, 0}, packed), "- 100");
  EXPECT_EQ(read_back(NC_UINT, {4294967295.0, 0}, packed), "- 100");
  EXPECT_EQ(read_back(NC_FLOAT, {9.9692099683868690e+36, 0}, packed), "- 100");
  EXPECT_EQ(read_back(NC_DOUBLE, {9.9692099683868690e+36, 0}, packed), "- 100");
  EXPECT_EQ(read_back(NC_SHORT, {-32767, -1}, all_of({packed, numbers("_FillValue", NC_SHORT, {-1})})), "-16283.5 -");
  EXPECT_EQ(read_back(NC_BYTE, {-127, 0}, packed), "36.5 100") << "each of a byte's values may be meant";
}

TEST(NetcdfPacking, RefusesAnAttributeOfAnotherKindThanItMustBe) {
  const auto complaint = [](const Defined& attributes) {
    try {
      (void)read_back(NC_SHORT, {0, 1}, attributes);
    } catch (const FileError& e) {
      const std::string said = e.what();
      return said.substr(said.find("v: "));
    }
    return std::string("nothing");
  };
  EXPECT_EQ(complaint(text("scale_factor", "2.0")), "v: scale_factor: must be one number");
  EXPECT_EQ(complaint(numbers("scale_factor", NC_DOUBLE, {2, 3})), "v: scale_factor: must be one number");
  EXPECT_EQ(complaint(text("add_offset", "-1000")), "v: add_offset: must be one number");
  EXPECT_EQ(complaint(text("valid_range", "0 1")), "v: valid_range: must be two numbers");
  EXPECT_EQ(complaint(numbers("valid_min", NC_SHORT, {0, 1})), "v: valid_min: must be one number");
  EXPECT_TRUE(support::tells(complaint(text("missing_value", "-9999")), {"missing_value", "number", "several"}));
  EXPECT_EQ(complaint(text("_Unsigned", "maybe")), "v: _Unsigned: must be true or false");
  EXPECT_EQ(complaint(numbers("missing_value", NC_SHORT, {5, 6})), "nothing");
}

TEST(NetcdfPacking, TakesTheSignFromUnsigned) {
  // The bits of -1 and -56 are those of 255 and 200.
  const Defined is_unsigned = text("_Unsigned", "true");
  EXPECT_EQ(read_back(NC_BYTE, {-1, -56, 7}, all_of({is_unsigned, numbers("_FillValue", NC_BYTE, {-1})})), "- 200 7");
  EXPECT_EQ(read_back(NC_SHORT, {-1, -2, 7}, all_of({is_unsigned, numbers("valid_range", NC_SHORT, {0, -2})})), "- 65534 7");
  EXPECT_EQ(read_back(NC_SHORT, {-2, 7}, text("_Unsigned", "True")), "65534 7");
  EXPECT_EQ(read_back(NC_UBYTE, {255, 200, 7}, text("_Unsigned", "false")), "-1 -56 7");
  EXPECT_EQ(read_back(NC_BYTE, {-1, -56, 7}, text("_Unsigned", "false")), "-1 -56 7");
}

}  // namespace
}  // namespace earshot::netcdf
