#include "sim/field_library/library.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <stdexcept>
#include <string>

#include "sim/field_library/reader.hpp"
#include "sim/netcdf/reader.hpp"
#include "sim/ocean/file/environment_file.hpp"
#include "tests/sim/sonar/hilly_ocean.hpp"
#include "tests/support/process.hpp"
#include "tests/support/temporary_folder.hpp"

namespace earshot::field_library {
namespace {

class Library : public testing::Test {
 protected:
  Library() { tests::write_hilly_ocean(folder_.path()); }

  LibraryPlan plan(const std::string& centre, const std::string& source_m, const std::string& receiver_m,
                   const std::string& environment = "hilly.toml") {
    std::ofstream(folder_ / "library.toml") << "name = \"test\"\nenvironment = \"" << environment << "\"\ncentre = \"" << centre
                                            << "\"\nsource_depth_m = [" << source_m << "]\nreceiver_depth_m = [" << receiver_m
                                            << "]\n[positions]\nlayout = \"list\"\nnorth_m = [0, 1000, 2000]\neast_m = [0, -3000, -6000]\n"
                                            << "[radials]\ncount = 4\nmax_range_km = 6.0\nrange_step_m = 50.0\naccuracy_db = 0.02\n";
    return load_library_plan(folder_ / "library.toml", ocean::load_environment);
  }
  [[nodiscard]] std::filesystem::path file() const { return folder_ / "library.nc"; }

  support::TemporaryFolder folder_;
  parallel::Alone alone_;
};

bool same(float a, float b) {
  return a == b || (std::isnan(a) && std::isnan(b));
}

TEST_F(Library, HoldsTheFanOfEveryPosition) {
  const LibraryPlan library = plan("source", "30", "100, 300");
  EXPECT_EQ(write_library(file(), library, 2, alone_).computed, 3U);
  const sonar::Fan read = read_library_fan(file(), 1);
  const sonar::Fan fan = sonar::compute_fan(library.environment, {Meters{1000.0}, Meters{-3000.0}}, library.fan, 2);
  EXPECT_EQ(read.centre, fan.centre);
  EXPECT_EQ(read.depth_m, fan.depth_m);
  EXPECT_EQ(read.range_step, fan.range_step);
  ASSERT_EQ(read.transmission_loss_db.size(), fan.transmission_loss_db.size());
  for (std::size_t i = 0; i < fan.transmission_loss_db.size(); ++i)
    ASSERT_TRUE(same(read.transmission_loss_db[i], fan.transmission_loss_db[i])) << i;
}

TEST_F(Library, RefusesADepthThatAFlatOceanHasNowhere) {
  const std::string flat = std::string(EARSHOT_SOURCE_DIR) + "/sim/ocean/environments/munk_flat.toml";
  EXPECT_NO_THROW((void)plan("source", "30", "300, 3000", flat));
  EXPECT_THROW((void)plan("source", "30", "300, 3001", flat), host::BadInput);
  EXPECT_NO_THROW((void)plan("source", "30", "300, 2400"));  // charts: some positions may be deep enough
}

TEST_F(Library, KeepsWhatWasComputedBeforeAnError) {
  const LibraryPlan library = plan("source", "30", "300");
  const auto fail_at_the_second = [](double fraction) {
    if (fraction > 0.5) throw std::runtime_error("power cut");
  };
  EXPECT_THROW(write_library(file(), library, 1, alone_, fail_at_the_second), std::runtime_error);
  EXPECT_FALSE(std::filesystem::exists(file()));
  const LibrarySummary rest = write_library(file(), library, 1, alone_);
  EXPECT_EQ(rest.found, 2U);
  EXPECT_EQ(rest.computed, 1U);
}

TEST_F(Library, ComputesNothingThatStandsThereFinished) {
  const LibraryPlan library = plan("source", "30", "300");
  (void)write_library(file(), library, 2, alone_);
  EXPECT_EQ(write_library(file(), library, 2, alone_).computed, 0U);
  EXPECT_THROW(write_library(file(), plan("source", "40", "300"), 2, alone_), netcdf::FileError) << "overwrote another of the same name";
}

TEST_F(Library, GivesBothDirectionsOfAFlatOceanTheSameLoss) {
  const std::string flat = std::string(EARSHOT_SOURCE_DIR) + "/sim/ocean/environments/munk_flat.toml";
  (void)write_library(file(), plan("source", "30", "100, 300", flat), 2, alone_);
  const sonar::Fan from_source = read_library_fan(file(), 0);
  (void)write_library(folder_ / "hydrophone.nc", plan("hydrophone", "30", "300", flat), 2, alone_);
  const sonar::Fan to_hydrophone = read_library_fan(folder_ / "hydrophone.nc", 2);
  double mean = 0.0;
  for (std::size_t i = 20; i < 120; ++i) mean += 0.01 * std::abs(static_cast<double>(from_source.at(1, i, 1) - to_hydrophone.at(2, i, 0)));
  EXPECT_LT(mean, 0.05);  // accuracy 0.02 dB of each
  for (std::size_t bearing = 0; bearing < 4; ++bearing) {
    for (std::size_t i = 0; i < 120; ++i) {
      ASSERT_TRUE(same(to_hydrophone.at(bearing, i, 0), to_hydrophone.at(0, i, 0))) << bearing << " " << i;
      ASSERT_FALSE(std::isnan(to_hydrophone.at(bearing, i, 0))) << bearing << " " << i;
    }
  }
  EXPECT_EQ(netcdf::Reader(folder_ / "hydrophone.nc").text_attribute("depth", "long_name"), "depth of the source");
}

TEST_F(Library, RefusesToReadAPositionThatItDoesNotHave) {
  (void)write_library(file(), plan("source", "30", "300"), 2, alone_);
  EXPECT_THROW((void)read_library_fan(file(), 3), netcdf::FileError);
}

TEST_F(Library, IsNotTheOneOfAnOceanThatWasEditedSince) {
  (void)write_library(file(), plan("source", "30", "300"), 2, alone_);
  std::string ocean = support::read_text(folder_ / "hilly.toml");
  const std::string level = "level_db_re_1upa_at_1m = 190.0";
  ocean.replace(ocean.find(level), level.size(), "level_db_re_1upa_at_1m = 180.0");
  std::ofstream(folder_ / "hilly.toml") << ocean;
  EXPECT_THROW(write_library(file(), plan("source", "30", "300"), 2, alone_), netcdf::FileError);
}

TEST_F(Library, SaysOfAPositionOnLandThatItHasNoWaterAndHoldsTheOthers) {
  LibraryPlan library = plan("source", "30", "300");
  library.positions = {{Meters{0.0}, Meters{7000.0}}, {Meters{0.0}, Meters{0.0}}};  // on the island, and west of it
  const LibrarySummary summary = write_library(file(), library, 2, alone_);
  EXPECT_EQ(summary.without_water, 1U);
  EXPECT_EQ(summary.computed, 1U);
  const FieldLibrary read(file());
  ASSERT_EQ(read.fans().size(), 1U);
  EXPECT_EQ(read.fans()[0].centre, NorthEast{});
}

}  // namespace
}  // namespace earshot::field_library
