#include "sim/sonar/field_library.hpp"

#include <gtest/gtest.h>

#include <limits>
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

}  // namespace
}  // namespace earshot::sonar
