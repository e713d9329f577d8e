#include "sim/sonar/field_file.hpp"

#include <gtest/gtest.h>
#include <netcdf.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

#include "sim/netcdf/reader.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text/tells.hpp"

namespace earshot::sonar {
namespace {

/// 3 ranges by 2 depths; the loss counts up along depth first.
SonarField small_field() {
  return {.range_m = {10.0, 20.0, 30.0},
          .depth_m = {5.0, 50.0},
          .source_level = Decibels{190.0},
          .noise_level = Decibels{90.0},
          .transmission_loss_db = {1, 2, 3, 4, 5, 6},
          .sea_floor_depth_m = {60.0F, 60.0F, 60.0F}};
}

class FieldFile : public testing::Test {
 protected:
  FieldFile() {
    environment_.name = "small";
    environment_.file_crc32 = 0x1234ABCDU;
  }

  [[nodiscard]] std::size_t files() const {
    std::size_t count = 0;
    for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(folder_)) ++count;
    return count;
  }

  const support::TemporaryFolder folder_;
  ocean::Environment environment_;
};

TEST_F(FieldFile, ReadsBackWhatWasWrittenWithDepthRunningFastest) {
  const auto path = folder_ / "field.nc";
  write_field(path, small_field(), environment_, Radians{}, ocean::Band{Hertz{20.0}, Hertz{20.0}}, "by hand");
  int id = 0;
  ASSERT_EQ(nc_open(path.c_str(), NC_NOWRITE, &id), NC_NOERR);
  int variable = 0;
  ASSERT_EQ(nc_inq_varid(id, "transmission_loss", &variable), NC_NOERR);
  std::array<float, 6> loss{};
  ASSERT_EQ(nc_get_var_float(id, variable, loss.data()), NC_NOERR);
  EXPECT_EQ(loss, (std::array<float, 6>{1, 2, 3, 4, 5, 6}));
  std::array<int, 2> dimensions{};
  ASSERT_EQ(nc_inq_vardimid(id, variable, dimensions.data()), NC_NOERR);
  std::array<char, NC_MAX_NAME + 1> name{};
  ASSERT_EQ(nc_inq_dimname(id, dimensions[1], name.data()), NC_NOERR);
  EXPECT_STREQ(name.data(), "depth");
  nc_close(id);
}

TEST_F(FieldFile, NamesItsConventionsUnitsAndProvenance) {
  const auto path = folder_ / "field.nc";
  write_field(path, small_field(), environment_, Radians{}, ocean::Band{Hertz{20.0}, Hertz{20.0}}, "by hand");
  int id = 0;
  ASSERT_EQ(nc_open(path.c_str(), NC_NOWRITE, &id), NC_NOERR);
  const auto text = [id](const char* variable, const char* attribute) {
    int number = NC_GLOBAL;
    if (*variable != '\0') nc_inq_varid(id, variable, &number);
    std::size_t length = 0;
    nc_inq_attlen(id, number, attribute, &length);
    std::string value(length, ' ');
    nc_get_att_text(id, number, attribute, value.data());
    return value;
  };
  EXPECT_EQ(text("", "Conventions"), "CF-1.11");
  EXPECT_EQ(text("", "history"), "by hand");
  EXPECT_EQ(text("", "environment_crc32"), "0x1234abcd");
  EXPECT_EQ(text("depth", "positive"), "down");
  EXPECT_EQ(text("range", "units"), "m");
  EXPECT_EQ(text("transmission_loss", "units"), "0.1 lg(re 1 m2)");
  EXPECT_EQ(text("transmission_loss", "level_unit"), "dB re 1 m");
  EXPECT_EQ(text("snr", "units"), "0.1 lg(re 1)");
  EXPECT_EQ(text("snr", "long_name"), "signal-to-noise ratio at the hydrophone, dB");
  EXPECT_NE(text("transmission_loss", "comment").find("rounded to 1/256 dB"), std::string::npos);
  nc_close(id);
}

/// Losses no two of which differ by a multiple of 1/256 dB, and one place without water.
SonarField odd_field() {
  SonarField field = small_field();
  field.transmission_loss_db = {60.0019F, 71.37F, 83.1234567F, 300.0F, 99.99871F, std::numeric_limits<float>::quiet_NaN()};
  return field;
}

TEST_F(FieldFile, HoldsTheLossWithinHalfOf1To256Decibel) {
  const SonarField field = odd_field();
  write_field(folder_ / "field.nc", field, environment_, Radians{}, ocean::Band{Hertz{20.0}, Hertz{20.0}}, "by hand");
  const std::vector<double> loss = netcdf::Reader(folder_ / "field.nc").read("transmission_loss");
  ASSERT_EQ(loss.size(), 6U);
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_EQ(256.0 * loss[i], std::floor(256.0 * loss[i])) << i;
    EXPECT_LE(std::abs(loss[i] - double{field.transmission_loss_db[i]}), 1.0 / 512.0) << i;
  }
  EXPECT_TRUE(std::isnan(loss[5]));
}

TEST_F(FieldFile, HasWhatSnrIsMadeOfInOneFile) {
  const SonarField field = odd_field();
  environment_.source.level = field.source_level;
  environment_.noise_level = field.noise_level;
  write_field(folder_ / "field.nc", field, environment_, Radians{}, ocean::Band{Hertz{20.0}, Hertz{20.0}}, "by hand");
  const netcdf::Reader file(folder_ / "field.nc");
  const double snr_db = file.read("source_level").at(0) - file.read("transmission_loss").at(1) - file.read("noise_level").at(0);
  EXPECT_NEAR(snr_db, 190.0 - 71.37 - 90.0, 1.0 / 512.0 + 1e-5);  // rounding of the file, and of a float
  EXPECT_NEAR(double{field.snr_db(0, 1)}, 190.0 - 71.37 - 90.0, 1e-5);
  EXPECT_NEAR(file.read("snr").at(1), 190.0 - 71.37 - 90.0, 1.0 / 512.0 + 1e-5);
}

TEST_F(FieldFile, SaysOfItsRadialWhereItPointsAndHowDeepTheSeaFloorIs) {
  SonarField field = small_field();
  field.sea_floor_depth_m = {60.0F, 55.0F, 50.0F};
  write_field(folder_ / "field.nc", field, environment_, Radians{0.5 * std::numbers::pi}, ocean::Band{Hertz{15.0}, Hertz{25.0}, 2}, "");
  const netcdf::Reader file(folder_ / "field.nc");
  EXPECT_EQ(file.read("bearing"), std::vector<double>{90.0});
  EXPECT_EQ(file.text_attribute("bearing", "units"), "degree");
  EXPECT_TRUE(support::tells(file.text_attribute("bearing", "long_name").value(), {"bearing", "radial", "clockwise", "north"}));
  EXPECT_EQ(file.read("sea_floor_depth"), (std::vector<double>{60.0, 55.0, 50.0}));
  EXPECT_EQ(file.text_attribute("sea_floor_depth", "units"), "m");
  EXPECT_EQ(file.read("range"), (std::vector<double>{10.0, 20.0, 30.0}));
  EXPECT_EQ(file.read("depth"), (std::vector<double>{5.0, 50.0}));
  EXPECT_EQ(file.read("source_frequency"), (std::vector<double>{17.5, 22.5}));
  EXPECT_EQ(file.text_attribute("source_frequency", "units"), "Hz");
  EXPECT_EQ(file.text_attribute("transmission_loss", "coordinates"), "source_depth bearing");
}

TEST_F(FieldFile, ReplacesAnOldFileAndLeavesNothingBeside) {
  const auto path = folder_ / "field.nc";
  write_field(path, small_field(), environment_, Radians{}, ocean::Band{Hertz{20.0}, Hertz{20.0}}, "first");
  write_field(path, small_field(), environment_, Radians{}, ocean::Band{Hertz{20.0}, Hertz{20.0}}, "second");
  EXPECT_EQ(files(), 1U);
}

TEST_F(FieldFile, NamesAFileThatCannotBeWritten) {
  const auto path = folder_ / "no" / "folder" / "field.nc";
  try {
    write_field(path, small_field(), environment_, Radians{}, ocean::Band{Hertz{20.0}, Hertz{20.0}}, "");
    FAIL();
  } catch (const std::runtime_error& e) {
    EXPECT_NE(std::string(e.what()).find(path.string()), std::string::npos) << e.what();
  }
}

TEST_F(FieldFile, LeavesNothingHalfWrittenWhenItCannotTakeItsName) {
  const auto path = folder_ / "field.nc";
  std::filesystem::create_directories(path / "in the way");
  EXPECT_THROW(write_field(path, small_field(), environment_, Radians{}, ocean::Band{Hertz{20.0}, Hertz{20.0}}, ""), std::runtime_error);
  EXPECT_EQ(files(), 1U);
}

}  // namespace
}  // namespace earshot::sonar
