#include "sim/vehicle/battery.hpp"

#include <gtest/gtest.h>

namespace earshot::vehicle {
namespace {

TEST(VehicleBattery, GivesEveryKilometreItsShareAndIsNeverBelowEmpty) {
  Battery battery{.percent = 50.0, .percent_per_km = 0.5};
  battery.sail(Meters{20'000.0});
  EXPECT_EQ(battery.percent, 40.0);
  battery.sail(Meters{81'000.0});
  EXPECT_EQ(battery.percent, 0.0);
}

}  // namespace
}  // namespace earshot::vehicle
