#include <netcdf.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <sstream>
#include <vector>

#include "tests/sim/apps/field/field_program.hpp"

namespace earshot::tests {
namespace {

const std::string kPekeris = std::string(EARSHOT_SOURCE_DIR) + "/sim/ocean/environments/pekeris.env";
const std::string kSlope = std::string(EARSHOT_SOURCE_DIR) + "/sim/ocean/environments/slope.in";

/// The same ocean as pekeris.env in Earshot's own words.
const std::string kPekerisToml = R"(
name = "Pekeris"
[source]
frequency_hz = 100.0
level_db_re_1upa_at_1m = 0.0
depth_m = 36.0
north_m = 0.0
east_m = 0.0
[noise]
level_db_re_1upa = 0.0
[water]
profile = "table"
depth_m = [0.0, 100.0]
sound_speed_mps = [1500.0, 1500.0]
[seabed]
depth_m = 100.0
[[seabed.layers]]
sound_speed_mps = 1700.0
density_g_per_cm3 = 1.8
attenuation_db_per_wavelength = 0.5
)";

std::vector<float> values_of(const std::string& path, const char* name, std::size_t count) {
  int file = -1;
  EXPECT_EQ(nc_open(path.c_str(), NC_NOWRITE, &file), NC_NOERR);
  int variable = -1;
  EXPECT_EQ(nc_inq_varid(file, name, &variable), NC_NOERR);
  std::vector<float> values(count);
  EXPECT_EQ(nc_get_var_float(file, variable, values.data()), NC_NOERR);
  nc_close(file);
  return values;
}

double predicted_error_db(const std::string& path) {
  int file = -1;
  EXPECT_EQ(nc_open(path.c_str(), NC_NOWRITE, &file), NC_NOERR);
  double value = std::nan("");
  EXPECT_EQ(nc_get_att_double(file, NC_GLOBAL, "predicted_error_db", &value), NC_NOERR);
  nc_close(file);
  return value;
}

/// Of a tl.grid file, [n_range x n_depth].
std::vector<std::vector<float>> losses_of(const std::string& path) {
  const std::string bytes = read(path);
  std::int32_t depths = 0;
  std::memcpy(&depths, bytes.data() + 4, sizeof(depths));
  std::vector<std::vector<float>> losses;
  for (std::size_t at = 12; at < bytes.size(); at += 8 + 4 * static_cast<std::size_t>(depths)) {
    losses.emplace_back(static_cast<std::size_t>(depths));
    std::memcpy(losses.back().data(), bytes.data() + at + 4, 4 * static_cast<std::size_t>(depths));
  }
  return losses;
}

class ModelFiles : public FieldProgram {
 protected:
  [[nodiscard]] std::string shade() const { return (folder_ / "out" / "field.shd").string(); }
  [[nodiscard]] std::string grid() const { return (folder_ / "out" / "tl.grid").string(); }
  std::string write(const std::string& name, const std::string& text) {
    std::ofstream(folder_ / name) << text;
    return (folder_ / name).string();
  }
};

TEST_F(ModelFiles, OfTheSameOceanGiveTheSameBitsAsAnEnvironmentFile) {
  ASSERT_EQ(run(kPekeris + " -o " + output()), 0) << errors();
  EXPECT_NE(said().find("100 ranges to 10 km, 49 depths from 2 to 98 m"), std::string::npos) << said();
  EXPECT_NE(said().find("names none: SNR is minus the loss"), std::string::npos) << said();
  const std::vector<float> loss_db = values_of(output(), "transmission_loss", 4900);
  std::string depths;
  for (int depth_m = 2; depth_m <= 98; depth_m += 2) depths += " " + std::to_string(depth_m);
  ASSERT_EQ(run(write("pekeris.toml", kPekerisToml) + " -o " + output() + " --max-range-km 10 --output-step-m 100 --depth" + depths), 0)
      << errors();
  EXPECT_EQ(loss_db, values_of(output(), "transmission_loss", 4900));
}

TEST_F(ModelFiles, GiveNetcdfTheReceiversOfTheFile) {
  std::string uneven = read(kPekeris);
  uneven.replace(uneven.find("100              !"), 3, "4  ");
  uneven.replace(uneven.find("0.1  10.0 /"), 11, "0 1.0033 2.71828 5.00017 /");
  uneven.replace(uneven.find("49               !"), 2, "3 ");
  uneven.replace(uneven.find("2.0  98.0 /"), 11, "0 50 150 /");
  const std::string path = write("uneven.env", uneven);
  ASSERT_EQ(run(path + " -o " + output()), 0) << errors();
  EXPECT_NE(said().find("4 ranges to 5.00017 km, 3 depths from 0 to 150 m"), std::string::npos) << said();
  const std::vector<float> range_m = values_of(output(), "range", 4);
  EXPECT_EQ(range_m, (std::vector{0.0F, 1003.3F, 2718.28F, 5000.17F}));
  EXPECT_EQ(values_of(output(), "depth", 3), (std::vector{0.0F, 50.0F, 150.0F}));
  const std::vector<float> loss_db = values_of(output(), "transmission_loss", 12);
  EXPECT_TRUE(std::isnan(loss_db[1])) << "at the source";
  EXPECT_TRUE(std::isnan(loss_db[5])) << "below the sea floor";
  EXPECT_EQ(loss_db[3], 300.0F) << "at the surface";
  ASSERT_EQ(run(path + " -o " + grid()), 0) << errors();
  const auto of_grid = losses_of(grid());
  for (std::size_t range = 1; range < 4; ++range) EXPECT_NEAR(loss_db[3 * range + 1], of_grid[range][1], 0.5F / 256.0F);
}

TEST_F(ModelFiles, AreKnownByTheirNamesInCapitalsToo) {
  const std::string path = write("A.ENV", read(kPekeris));
  const std::filesystem::path out = folder_ / "out";
  ASSERT_EQ(run(path + " -o " + (out / "A.SHD").string()), 0) << errors();
  ASSERT_EQ(run(path + " -o " + (out / ".shd").string()), 0) << errors();
  EXPECT_EQ(read(out / "A.SHD"), read(out / ".shd"));
  ASSERT_EQ(run(path + " -o " + (out / "A.GRID").string()), 0) << errors();
  EXPECT_EQ(losses_of((out / "A.GRID").string()).size(), 100U);
  ASSERT_EQ(run(write("A.IN", read(kSlope)) + " -o " + output() + " --max-range-km 1"), 0) << errors();
}

TEST_F(ModelFiles, OfATitleThatWouldSteerATerminalShowWhatItIs) {
  std::string text = kPekerisToml;
  text.replace(text.find("Pekeris"), 7, "P\\u001b[31m");
  ASSERT_EQ(run(write("p.toml", text) + " -o " + output() + " --max-range-km 1"), 0) << errors();
  EXPECT_EQ(said().find('\x1b'), std::string::npos) << said();
  EXPECT_NE(said().find("P\\x1b[31m"), std::string::npos) << said();
}

TEST_F(ModelFiles, GiveOptionsTheLastWord) {
  ASSERT_EQ(run(kPekeris + " -o " + output() + " --max-range-km 1 --output-step-m 50 --depth 10 20"), 0) << errors();
  EXPECT_NE(said().find("20 ranges to 1 km, 2 depths from 10 to 20 m"), std::string::npos) << said();
  ASSERT_EQ(run(kPekeris + " -o " + output() + " --radials 2 --receiver-depth-m 50"), 0) << errors();
  EXPECT_NE(said().find("ranges to 10 km"), std::string::npos) << said();
}

TEST_F(ModelFiles, OfSeveralSourcesWantOneOfThemChosen) {
  std::string several = read(kPekeris);
  const std::string one = "1                ! source depths\n  36.0 /";
  several.replace(several.find(one), one.size(), "2\n  36.0 50.0 /");
  const std::string path = write("several.env", several);
  expect_refused(path + " -o " + output(),
                 "several.env: has 2 source depths, from 36 to 50 m: a field has one; choose it with --source-depth-m");
  expect_refused(path + " -o " + output() + " --source-depth-m 100",
                 "--source-depth-m = 100: must be less than the depth of the sea floor there, 100 m");
  ASSERT_EQ(run(path + " -o " + output() + " --source-depth-m 36"), 0) << errors();
  const std::vector<float> chosen = values_of(output(), "transmission_loss", 4900);
  ASSERT_EQ(run(kPekeris + " -o " + output()), 0) << errors();
  EXPECT_EQ(chosen, values_of(output(), "transmission_loss", 4900));
}

TEST_F(ModelFiles, HoldTheLossOfTheFieldAsPressure) {
  ASSERT_EQ(run(kPekeris + " -o " + output()), 0) << errors();
  ASSERT_EQ(run(kPekeris + " -o " + shade()), 0) << errors();
  const std::vector<float> loss_db = values_of(output(), "transmission_loss", 4900);
  const std::string bytes = read(shade());
  constexpr std::size_t kRecord = std::size_t{4} * 200;
  ASSERT_EQ(bytes.size(), 59 * kRecord);
  for (std::size_t depth = 0; depth < 49; ++depth) {
    for (std::size_t range = 0; range < 100; ++range) {
      float pressure[2];
      std::memcpy(pressure, bytes.data() + (10 + depth) * kRecord + 8 * range, sizeof(pressure));
      // NetCDF holds multiples of 1/256 dB.
      ASSERT_NEAR(-20.0F * std::log10(std::hypot(pressure[0], pressure[1])), loss_db[range * 49 + depth], 0.5F / 256.0F + 1e-4F);
    }
  }
}

TEST_F(ModelFiles, OfRamGiveItsGrid) {
  ASSERT_EQ(run(kSlope + " -o " + grid()), 0) << errors();
  const auto losses = losses_of(grid());
  ASSERT_EQ(losses.size(), 80U);               // 100, 200, ... 8000 m: every fifth of 400 steps of 20 m
  ASSERT_EQ(losses.front().size(), 74U);       // nodes 4, 8, ... 299: 3, 7, ... 295 m
  EXPECT_TRUE(std::isnan(losses.back()[20]));  // 83 m, the floor there is at 62 m
  EXPECT_FALSE(std::isnan(losses.back()[10]));
  // The same field at a range and depth of the grid, from the command's own words: 1100 m, 43 m.
  ASSERT_EQ(run(kSlope + " -o " + output() + " --depth 43 --max-range-km 1.1 --output-step-m 20"), 0) << errors();
  EXPECT_NEAR(losses[10][10], values_of(output(), "transmission_loss", 55).back(), 0.05F);  // grids of another length of the march
}

TEST_F(ModelFiles, OfRamAreNotReplacedUnasked) {
  // What RAM itself writes: a record with the number of depths, then the losses.
  const std::string of_ram("\4\0\0\0\1\0\0\0\4\0\0\0\4\0\0\0\0\0\240A\4\0\0\0", 24);
  std::ofstream(grid(), std::ios::binary) << of_ram;
  EXPECT_EQ(run(kSlope + " -o " + grid()), 2);
  EXPECT_NE(errors().find("is there already and is not known to be Earshot's"), std::string::npos) << errors();
  EXPECT_EQ(read(grid()), of_ram);
  EXPECT_EQ(run(kSlope + " --force -o " + grid()), 0) << errors();
  EXPECT_NE(read(grid()), of_ram);
}

/// A sea floor that goes up and down by 20 m every 5 m.
TEST_F(ModelFiles, OverARoughSeaFloorAreRefused) {
  std::string rough = read(kPekeris);
  std::ostringstream floor;
  floor << "'L'\n2001\n";
  for (int i = 0; i <= 2000; ++i) floor << 0.005 * i << ' ' << (i % 2 == 0 ? 100 : 80) << '\n';
  rough.replace(rough.find("'A'  0.0"), 8, "'A~' 0.0");
  write("rough.bty", floor.str());
  const std::string path = write("rough.env", rough);
  expect_refused(path + " -o " + output(),
                 " dB in the mean where 0.02 dB was asked for: the sea floor is too rough for the solver's steps");
  expect_refused(path + " -o " + shade(), "smooth it, or choose the range step yourself");
  EXPECT_EQ(run(path + " -o " + output() + " --range-step 5"), 0) << errors();
}

TEST_F(ModelFiles, OverARoughishSeaFloorAreWarnedOf) {
  std::string hilly = kPekerisToml;
  hilly += "[bathymetry]\nlayout = \"section\"\nrange_m = [0.0";
  std::string depths = "100.0";
  for (int i = 1; i <= 200; ++i) {
    hilly += ", " + std::to_string(50 * i) + ".0";
    depths += i % 2 == 0 ? ", 100.0" : ", 80.0";
  }
  const std::string keyed = "depth_m = 100.0\n[[";
  hilly += "]\ndepth_m = [" + depths + "]\n";
  hilly.replace(hilly.find(keyed), keyed.size(), "[[");
  ASSERT_EQ(run(write("hilly.toml", hilly) + " -o " + output() + " --max-range-km 10"), 0) << errors();
  EXPECT_NE(errors().find("warning: the error of transmission loss is predicted to be "), std::string::npos) << errors();
  // 0.2 dB integral of tan^2 / depth: (20 / 50)^2 / 89.6 m over 10 km, by hand; depth in the harmonic mean.
  EXPECT_NEAR(predicted_error_db(output()), 3.57, 0.1);
  ASSERT_EQ(run((folder_ / "hilly.toml").string() + " -o " + output() + " --max-range-km 10 --radials 2 --receiver-depth-m 50 --force"), 0)
      << errors();
  EXPECT_NE(errors().find("warning: the error of transmission loss is predicted to be "), std::string::npos) << errors();
  EXPECT_NEAR(predicted_error_db(output()), 3.57, 0.1);
  ASSERT_EQ(run(kPekeris + " -o " + output()), 0) << errors();
  EXPECT_EQ(errors(), "");
  EXPECT_LE(predicted_error_db(output()), 0.02);
}

TEST_F(ModelFiles, AreRefusedWithFileAndLine) {
  const std::string text = read(kPekeris);
  std::string solid = text;
  solid.replace(solid.find("1700.0  0.0"), 11, "1700.0 300.0");
  expect_refused(write("solid.env", solid) + " -o " + output(),
                 "solid.env:9: shear speed in m/s = 300: must be 0: only fluid media are computed");
  expect_refused(write("cut.env", text.substr(0, text.size() / 2)) + " -o " + output(), "cut.env:");
}

TEST_F(ModelFiles, HoldOneRadialOfOneFrequency) {
  expect_refused(kPekeris + " -o " + shade() + " --radials 4 --receiver-depth-m 50", "--output: a .shd or .grid file holds one radial");
  expect_refused(kPekeris + " -o " + grid() + " --radials 4 --receiver-depth-m 50", "--output: a .shd or .grid file holds one radial");
  expect_refused(kPekeris + " -o " + shade() + " --band-hz 80 120", "holds the pressure of one frequency, not of --band-hz");
  expect_refused(kPekeris + " -o " + output() + " --shd-layout single", "--shd-layout needs --output NAME.shd");
}

}  // namespace
}  // namespace earshot::tests
