#include "sim/sonar/fan_file.hpp"

#include <gtest/gtest.h>
#include <netcdf.h>

#include <cmath>
#include <cstddef>
#include <filesystem>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "sim/netcdf/reader.hpp"
#include "tests/sim/sonar/charted_ocean.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text/tells.hpp"

namespace earshot::sonar {
namespace {

constexpr float kLand = std::numeric_limits<float>::quiet_NaN();
constexpr Detector kDetector{
    .source_level = Decibels{190.0}, .noise_level = Decibels{90.0}, .detection_threshold = Decibels{10.0}, .fluctuation = Decibels{6.0}};

ocean::Environment environment() {
  ocean::Environment small;
  small.name = "small";
  return small;
}

/// Two bearings, three ranges, one depth.
Fan fan() {
  return {.centre = {Meters{10.0}, Meters{20.0}},
          .bearings = 2,
          .ranges = 3,
          .range_step = Meters{100.0},
          .depth_m = {300.0},
          .transmission_loss_db = {80, 84, 96, 84, kLand, kLand},
          .sea_floor_depth_m = {500, 400, 350, 320, 0, 0}};
}

TEST(FanFile, ReadsBackLossProbabilityAndDetectionRanges) {
  const support::TemporaryFolder folder;
  write_fan(folder / "fan.nc", fan(), std::nullopt, environment(), {Hertz{20.0}, Hertz{20.0}}, kDetector, "by hand");
  const netcdf::Reader file(folder / "fan.nc");
  EXPECT_EQ(file.dimensions_of("transmission_loss"), (std::vector<std::string>{"bearing", "range", "depth"}));
  EXPECT_EQ(file.read("bearing"), (std::vector<double>{0.0, 180.0}));
  EXPECT_EQ(file.read("range"), (std::vector<double>{100.0, 200.0, 300.0}));
  EXPECT_EQ(file.read("transmission_loss")[1], 84.0);
  EXPECT_NEAR(file.read("detection_probability")[1], 0.84134, 5e-6);  // one sigma: Abramowitz & Stegun, table 26.1
  EXPECT_TRUE(std::isnan(file.read("transmission_loss")[4]));
  EXPECT_EQ(file.read("furthest_detection_range"), (std::vector<double>{250.0, 100.0}));
  EXPECT_EQ(file.text_attribute("sea_floor_depth", "standard_name"), "sea_floor_depth_below_sea_surface");
  EXPECT_FALSE(file.has_variable("snr"));
  EXPECT_FALSE(file.has_variable("map_snr"));
}

TEST(FanFile, HoldsTheMapBesideTheFan) {
  const support::TemporaryFolder folder;
  const HorizontalMap map = make_map(fan(), 0, {.side = Meters{200.0}, .intervals = 2}, kDetector);
  write_fan(folder / "fan.nc", fan(), map, environment(), {Hertz{15.0}, Hertz{30.0}, 3}, kDetector, "by hand");
  const netcdf::Reader file(folder / "fan.nc");
  EXPECT_EQ(file.dimensions_of("map_snr"), (std::vector<std::string>{"north", "east"}));
  EXPECT_EQ(file.read("north"), (std::vector<double>{-90.0, 10.0, 110.0}));
  EXPECT_EQ(file.read("map_snr")[2 * 3 + 1], 20.0);  // 100 m north
  EXPECT_EQ(file.read("east"), (std::vector<double>{-80.0, 20.0, 120.0}));
  EXPECT_NEAR(file.read("map_detection_probability")[2 * 3 + 1], 0.95221, 5e-6);  // 10/6 sigma: Abramowitz & Stegun, table 26.1
  EXPECT_EQ(file.read("source_frequency"), (std::vector<double>{17.5, 22.5, 27.5}));
}

TEST(FanFile, HasTheDetectionRangesOfEveryDepth) {
  const support::TemporaryFolder folder;
  Fan two_depths = fan();
  two_depths.depth_m = {30.0, 300.0};
  two_depths.transmission_loss_db = {95, 80, 96, 84, 97, 96, 95, 84, kLand, kLand, kLand, kLand};  // nothing is heard at 30 m
  write_fan(folder / "fan.nc", two_depths, std::nullopt, environment(), {Hertz{20.0}, Hertz{20.0}}, kDetector, "by hand");
  const netcdf::Reader file(folder / "fan.nc");
  EXPECT_EQ(file.dimensions_of("furthest_detection_range"), (std::vector<std::string>{"depth", "bearing"}));
  EXPECT_EQ(file.read("furthest_detection_range"), (std::vector<double>{0.0, 0.0, 250.0, 100.0}));
  EXPECT_EQ(file.read("assured_detection_range"), (std::vector<double>{0.0, 0.0, 250.0, 100.0}));
}

/// Reads attributes that netcdf::Reader has no use for: those of the whole file (variable "") and numbers.
class Attributes {
 public:
  explicit Attributes(const std::filesystem::path& path) {
    if (nc_open(path.c_str(), NC_NOWRITE, &file_) != NC_NOERR) ADD_FAILURE() << path;
  }
  ~Attributes() { nc_close(file_); }
  Attributes(const Attributes&) = delete;
  Attributes& operator=(const Attributes&) = delete;

  [[nodiscard]] std::string text(const std::string& variable, const std::string& attribute) const {
    std::size_t length = 0;
    if (nc_inq_attlen(file_, id(variable), attribute.c_str(), &length) != NC_NOERR) return "none";
    std::string value(length, ' ');
    return nc_get_att_text(file_, id(variable), attribute.c_str(), value.data()) == NC_NOERR ? value : "no text";
  }
  [[nodiscard]] double number(const std::string& variable, const std::string& attribute) const {
    double value = std::numeric_limits<double>::quiet_NaN();
    nc_get_att_double(file_, id(variable), attribute.c_str(), &value);
    return value;
  }

 private:
  [[nodiscard]] int id(const std::string& variable) const {
    int number = NC_GLOBAL;
    if (!variable.empty() && nc_inq_varid(file_, variable.c_str(), &number) != NC_NOERR) ADD_FAILURE() << "no " << variable;
    return number;
  }
  int file_ = -1;
};

/// The example's source, 190 dB, heard in 90 dB, in a charted ocean.
ocean::Environment charted_environment() {
  ocean::Environment sea = tests::charted_ocean();
  sea.source = {.frequency = Hertz{20.0}, .level = Decibels{190.0}, .depth = Meters{30.0}, .position = {Meters{10.0}, Meters{20.0}}};
  sea.noise_level = Decibels{90.0};
  return sea;
}

TEST(FanFile, SaysOfEveryNumberWhatItIsAndInWhichUnit) {
  const support::TemporaryFolder folder;
  write_fan(folder / "fan.nc", fan(), std::nullopt, charted_environment(), {Hertz{20.0}, Hertz{20.0}}, kDetector, "by hand");
  const netcdf::Reader file(folder / "fan.nc");
  const Attributes attributes(folder / "fan.nc");
  struct Row {
    const char* name;
    double value;
    const char* unit;
    const char* long_name;
  };
  for (const Row& row :
       {Row{"source_frequency", 20.0, "Hz", "frequency of the source"}, Row{"source_depth", 30.0, "m", "depth of the source"},
        Row{"source_north", 10.0, "m", "northing of the source in the local plane"},
        Row{"source_east", 20.0, "m", "easting of the source in the local plane"},
        Row{"source_level", 190.0, "0.1 lg(re 1 uPa2 m2)", "source level, dB re 1 uPa at 1 m"},
        Row{"noise_level", 90.0, "0.1 lg(re 1 uPa2)", "noise level in the detector's band, dB re 1 uPa"},
        Row{"detection_threshold", 10.0, "0.1 lg(re 1)", "signal-to-noise ratio needed for detection, dB"},
        Row{"fluctuation", 6.0, "0.1 lg(re 1)", "standard deviation of the signal-to-noise ratio, which is normal, dB"}}) {
    EXPECT_EQ(file.read(row.name), std::vector<double>{row.value}) << row.name;
    EXPECT_EQ(attributes.text(row.name, "units"), row.unit) << row.name;
    EXPECT_EQ(attributes.text(row.name, "long_name"), row.long_name) << row.name;
  }
  EXPECT_EQ(file.read("depth"), std::vector<double>{300.0});
  EXPECT_EQ(file.read("sea_floor_depth"), (std::vector<double>{500, 400, 350, 320, 0, 0}));
  EXPECT_EQ(file.read("assured_detection_range"), (std::vector<double>{250.0, 100.0}));
  EXPECT_EQ(attributes.text("bearing", "units"), "degree");
  EXPECT_EQ(attributes.text("range", "units"), "m");
  EXPECT_EQ(attributes.text("depth", "units"), "m");
  EXPECT_EQ(attributes.text("sea_floor_depth", "units"), "m");
  EXPECT_EQ(attributes.text("detection_probability", "units"), "1");
  EXPECT_EQ(attributes.text("assured_detection_range", "units"), "m");
  EXPECT_EQ(attributes.text("furthest_detection_range", "units"), "m");
  EXPECT_EQ(attributes.text("transmission_loss", "coordinates"), "none");             // its dimensions say where
  EXPECT_EQ(attributes.number("transmission_loss", "least_significant_digit"), 2.0);  // 1/256 dB is good to 0.01
  for (const char* name : {"transmission_loss", "detection_probability", "sea_floor_depth", "assured_detection_range"})
    EXPECT_TRUE(std::isnan(attributes.number(name, "_FillValue"))) << name;
}

TEST(FanFile, SaysWhatMadeItAndHowItIsRead) {
  const support::TemporaryFolder folder;
  ocean::Environment sea = charted_environment();
  sea.file_crc32 = 0x0A1B2C3D;
  write_fan(folder / "fan.nc", fan(), std::nullopt, sea, {Hertz{20.0}, Hertz{20.0}}, kDetector, "by hand");
  const Attributes attributes(folder / "fan.nc");
  EXPECT_EQ(attributes.text("", "Conventions"), "CF-1.11");
  EXPECT_EQ(attributes.text("", "title"), "Sound around one source: charted");
  EXPECT_EQ(attributes.text("", "source"), "Earshot, one-way parabolic equation");
  EXPECT_EQ(attributes.text("", "history"), "by hand");
  EXPECT_EQ(attributes.text("", "environment_crc32"), "0x0a1b2c3d");
  EXPECT_NE(attributes.text("", "interpolation").find("N x 2D"), std::string::npos);
  EXPECT_TRUE(support::tells(attributes.text("", "unmeasured_water"), {"woa.nc", "1500 m"}));
  write_fan(folder / "fan.nc", fan(), std::nullopt, environment(), {Hertz{20.0}, Hertz{20.0}}, kDetector, "by hand");
  EXPECT_EQ(Attributes(folder / "fan.nc").text("", "unmeasured_water"), "none");
}

TEST(FanFile, GivesItsMapTheProjectionOfTheChart) {
  const support::TemporaryFolder folder;
  const HorizontalMap map = make_map(fan(), 0, {.side = Meters{200.0}, .intervals = 2}, kDetector);
  ocean::Environment sea = charted_environment();
  auto charts = std::make_shared<ocean::Charts>(*sea.charts);
  charts->grid.origin = {.latitude_deg = 0.25, .longitude_deg = -0.5};
  sea.charts = charts;
  write_fan(folder / "fan.nc", fan(), map, sea, {Hertz{20.0}, Hertz{20.0}}, kDetector, "by hand");
  const Attributes attributes(folder / "fan.nc");
  EXPECT_EQ(attributes.text("local_plane", "grid_mapping_name"), "azimuthal_equidistant");
  EXPECT_EQ(attributes.number("local_plane", "latitude_of_projection_origin"), 0.25);
  EXPECT_EQ(attributes.number("local_plane", "longitude_of_projection_origin"), -0.5);
  EXPECT_EQ(attributes.number("local_plane", "false_easting"), 0.0);
  EXPECT_EQ(attributes.number("local_plane", "false_northing"), 0.0);
  EXPECT_EQ(attributes.number("local_plane", "semi_major_axis"), 6'378'137.0);  // WGS 84: NIMA TR8350.2
  EXPECT_EQ(attributes.number("local_plane", "inverse_flattening"), 298.257223563);
  EXPECT_EQ(attributes.text("map_snr", "grid_mapping"), "local_plane");
  EXPECT_EQ(attributes.text("map_detection_probability", "grid_mapping"), "local_plane");
  EXPECT_EQ(attributes.text("north", "standard_name"), "projection_y_coordinate");
  EXPECT_EQ(attributes.text("east", "standard_name"), "projection_x_coordinate");
  EXPECT_EQ(attributes.text("map_snr", "units"), "0.1 lg(re 1)");
  EXPECT_EQ(attributes.text("map_detection_probability", "units"), "1");

  write_fan(folder / "fan.nc", fan(), map, environment(), {Hertz{20.0}, Hertz{20.0}}, kDetector, "by hand");  // no origin, no projection
  EXPECT_FALSE(netcdf::Reader(folder / "fan.nc").has_variable("local_plane"));
  EXPECT_EQ(Attributes(folder / "fan.nc").text("map_snr", "grid_mapping"), "none");
}

}  // namespace
}  // namespace earshot::sonar
