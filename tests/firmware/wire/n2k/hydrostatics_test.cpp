#include "firmware/wire/n2k/hydrostatics.hpp"

#include <gtest/gtest.h>

namespace earshot::n2k {
namespace {

TEST(Hydrostatics, TenMetresOfSeaWaterPressWithOneBarAndABit) {
  // By hand: 1025 kg/m3 * 9.80665 m/s2 * 10 m = 100518.1625 Pa.
  EXPECT_DOUBLE_EQ(gauge_pressure_pa_at(Meters{10.0}), 100'518.1625);
  EXPECT_DOUBLE_EQ(depth_of(100'518.1625).value, 10.0);
}

}  // namespace
}  // namespace earshot::n2k
