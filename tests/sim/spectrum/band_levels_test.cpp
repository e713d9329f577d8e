#include "sim/spectrum/band_levels.hpp"

#include <gtest/gtest.h>

namespace earshot::spectrum {
namespace {

TEST(BandLevels, GiveTheMeanPowerAndPercentilesOfEachInterval) {
  // One band with powers of 1 to 5 in the first ten samples, then 100; a flat density p over 4.604 Hz has 4.604 p.
  BandLevels levels(third_octaves(Hertz{17}, Hertz{23}), Hertz{1}, 10);
  for (int i = 1; i <= 5; ++i) levels.take(std::vector<float>(100, static_cast<float>(i / 4.6040)), static_cast<std::uint64_t>(i));
  levels.take(std::vector<float>(100, static_cast<float>(100.0 / 4.6040)), 10);
  levels.finish();
  EXPECT_EQ(levels.begins(), (std::vector<std::uint64_t>{0, 10}));
  EXPECT_NEAR(levels.mean_level_db()[0], 4.771, 0.001);  // 10 lg 3
  EXPECT_NEAR(levels.mean_level_db()[1], 20.0, 0.001);
  EXPECT_NEAR(levels.percentile_level_db()[1], 3.010, 0.001);  // a quarter of 1 to 5 is no more than 2
  EXPECT_NEAR(levels.percentile_level_db()[2], 4.771, 0.001);  // the median is 3
}

}  // namespace
}  // namespace earshot::spectrum
