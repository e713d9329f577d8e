#include "firmware/messages/vehicle_status.hpp"

#include <gtest/gtest.h>

namespace earshot::messages {
namespace {

VehicleStatus status_of(double altitude_m, double battery_percent) {
  return {.time = Time{1}, .altitude = Meters{altitude_m}, .battery_percent = battery_percent, .has_leak = true, .has_ground_fault = true};
}

bool is_known(double value) {
  return value == value;
}

TEST(VehicleStatus, KeepsItsAlarmsBesideNumbersThatAreNone) {
  for (const double wrong : {1e308, -1e308, 12'001.0, -11.0}) {
    const VehicleStatus usable = usable_part_of(status_of(wrong, 50));
    EXPECT_FALSE(is_known(usable.altitude.value)) << wrong;
    EXPECT_EQ(usable.battery_percent, 50.0);
    EXPECT_TRUE(usable.has_leak && usable.has_ground_fault);
  }
  for (const double wrong : {1e308, 111.0, -2.0}) {
    const VehicleStatus usable = usable_part_of(status_of(20, wrong));
    EXPECT_FALSE(is_known(usable.battery_percent)) << wrong;
    EXPECT_EQ(usable.altitude, Meters{20});
  }
  EXPECT_EQ(usable_part_of(status_of(12'000, 110)), status_of(12'000, 110));
}

}  // namespace
}  // namespace earshot::messages
