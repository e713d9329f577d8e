#include "sim/sonar/field_library.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "sim/netcdf/file_error.hpp"
#include "sim/sonar/library_store.hpp"
#include "tests/sim/netcdf/temporary_folder.hpp"

namespace earshot::sonar {
namespace {

/// Three positions, the middle one on land; four bearings, ranges 100 m and 200 m, depths 10 m and 50 m. Nothing is computed: the loss at
/// position p, bearing b, range r, depth d is 100 p + 10 b + r + 5 d (their indices).
class FieldLibraryInMemory : public testing::Test {
 protected:
  FieldLibraryInMemory() {
    plan_.environment.source.level = Decibels{190.0};
    plan_.environment.noise_level = Decibels{90.0};
  }

  [[nodiscard]] static std::vector<float> loss_db(std::size_t position) {
    std::vector<float> values;
    for (std::size_t b = 0; b < 4; ++b)
      for (std::size_t r = 0; r < 2; ++r)
        for (std::size_t d = 0; d < 2; ++d) values.push_back(static_cast<float>(100 * position + 10 * b + r + 5 * d));
    values.back() = std::numeric_limits<float>::quiet_NaN();  // west, 200 m, 50 m: below the sea floor
    return values;
  }

  void write() {
    LibraryStore store(path_, plan_);
    store.mark(1, PositionState::kNoWater);
    for (const std::size_t position : {0U, 2U}) store.write(position, loss_db(position));
    store.commit();
  }

  tests::TemporaryFolder folder_;
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
  EXPECT_EQ(library.nearest({Meters{100.0}, Meters{990.0}}), 0U);  // not the one on land
  EXPECT_EQ(library.nearest({Meters{3000.0}, Meters{0.0}}), 1U);
}

TEST_F(FieldLibraryInMemory, GivesTheSnrOfItsFans) {
  write();
  const FieldLibrary library(path_);
  // 190 - 90 less the loss. East of the first, 150 m: halfway from 10 to 11 dB. South of the last, 200 m, 50 m deep: 200 + 20 + 1 + 5.
  EXPECT_NEAR(library.snr(0, {Meters{0.0}, Meters{150.0}}, 0).value, 89.5, 1e-5);
  EXPECT_NEAR(library.snr(1, {Meters{4800.0}, Meters{0.0}}, 1).value, -126.0, 1e-5);
  // South-east at 100 m: halfway from 10 to 20 dB, and 5 dB for the depth.
  const Meters part{100.0 / std::numbers::sqrt2};
  EXPECT_NEAR(library.snr(0, {-1.0 * part, part}, 1).value, 80.0, 1e-5);
}

TEST_F(FieldLibraryInMemory, IsSilentAndNeverNaNWhereThereIsNoWaterOrNoField) {
  write();
  const FieldLibrary library(path_);
  EXPECT_EQ(library.snr(0, {Meters{0.0}, Meters{-200.0}}, 1), Decibels{190.0 - 300.0 - 90.0});
  EXPECT_EQ(library.snr(0, {Meters{0.0}, Meters{201.0}}, 0), Decibels{190.0 - 300.0 - 90.0});
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

}  // namespace
}  // namespace earshot::sonar
