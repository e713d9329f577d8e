#include "sim/spectrum/third_octaves.hpp"

#include <gtest/gtest.h>

namespace earshot::spectrum {
namespace {

// IEC 61260-1:2014, table of exact base-ten frequencies: nominal 20 Hz is 19.953 Hz, from 17.783 to 22.387 Hz.
TEST(ThirdOctaves, HaveTheEdgesOfTheStandard) {
  const std::vector<ThirdOctave> bands = third_octaves(Hertz{10}, Hertz{25});
  ASSERT_EQ(bands.size(), 3U);  // nominal 12.5, 16 and 20 Hz; that of 10 Hz begins at 8.9 Hz, that of 25 Hz ends at 28.2 Hz
  EXPECT_NEAR(bands[2].centre.value, 19.953, 5e-4);
  EXPECT_NEAR(bands[2].low.value, 17.783, 5e-4);
  EXPECT_NEAR(bands[2].high.value, 22.387, 5e-4);
}

TEST(ThirdOctaves, TakeBinsByTheShareThatLiesInside) {
  const std::vector<float> flat(100, 2.0F);
  EXPECT_NEAR(power_in(flat, Hertz{1}, Hertz{17.783}, Hertz{22.387}), 2.0 * 4.604, 1e-9);
  EXPECT_EQ(power_in(flat, Hertz{1}, Hertz{200}, Hertz{300}), 0.0);
}

}  // namespace
}  // namespace earshot::spectrum
