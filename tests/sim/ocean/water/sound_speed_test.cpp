#include "sim/ocean/water/sound_speed.hpp"

#include <gtest/gtest.h>

namespace earshot::ocean {
namespace {

TEST(MunkProfile, AgreesWithAnIndependentTable) {
  // Computed independently for the reference case munk_20hz (case.json, water.profiles), to 1e-6 m/s.
  const SoundSpeedProfile munk = MunkProfile{MetersPerSecond{1500.0}, Meters{1300.0}, Meters{1300.0}, 0.00737};
  EXPECT_NEAR(sound_speed(munk, Meters{0.0}).value, 1548.521015, 1e-6);
  EXPECT_NEAR(sound_speed(munk, Meters{300.0}).value, 1523.42508, 1e-6);
  EXPECT_NEAR(sound_speed(munk, Meters{1300.0}).value, 1500.0, 1e-6);
  EXPECT_NEAR(sound_speed(munk, Meters{2000.0}).value, 1504.616182, 1e-6);
}

TEST(TabulatedProfile, IsLinearBetweenItsDepths) {
  const SoundSpeedProfile table = TabulatedProfile{{0.0, 100.0, 300.0}, {1500.0, 1480.0, 1520.0}};
  EXPECT_DOUBLE_EQ(sound_speed(table, Meters{25.0}).value, 1495.0);
  EXPECT_DOUBLE_EQ(sound_speed(table, Meters{100.0}).value, 1480.0);
  EXPECT_DOUBLE_EQ(sound_speed(table, Meters{250.0}).value, 1510.0);
}

TEST(TabulatedProfile, IsConstantBeyondItsEnds) {
  const SoundSpeedProfile table = TabulatedProfile{{10.0, 100.0}, {1500.0, 1480.0}};
  EXPECT_DOUBLE_EQ(sound_speed(table, Meters{0.0}).value, 1500.0);
  EXPECT_DOUBLE_EQ(sound_speed(table, Meters{500.0}).value, 1480.0);
}

}  // namespace
}  // namespace earshot::ocean
