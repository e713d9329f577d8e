#include "firmware/messages/navigation.hpp"

#include <gtest/gtest.h>

#include "tests/firmware/not_finite.hpp"

namespace earshot::messages {
namespace {

using tests::kInfinity;
using tests::kNan;

constexpr Navigation kFix{.time = Time{1},
                          .position = {.north = Meters{2}, .east = Meters{3}},
                          .depth = Meters{4},
                          .heading = Radians{0.5},
                          .speed = MetersPerSecond{1.5}};

template <class Change>
bool is_usable_with(Change change) {
  Navigation fix = kFix;
  change(fix);
  return is_usable(fix);
}

TEST(Navigation, IsOfNoUseWithAnyOneNumberThatIsNone) {
  EXPECT_TRUE(is_usable(kFix));
  for (const double wrong : {kNan, kInfinity, -kInfinity}) {
    EXPECT_FALSE(is_usable_with([wrong](Navigation& fix) { fix.position.north = Meters{wrong}; })) << wrong;
    EXPECT_FALSE(is_usable_with([wrong](Navigation& fix) { fix.position.east = Meters{wrong}; })) << wrong;
    EXPECT_FALSE(is_usable_with([wrong](Navigation& fix) { fix.depth = Meters{wrong}; })) << wrong;
    EXPECT_FALSE(is_usable_with([wrong](Navigation& fix) { fix.heading = Radians{wrong}; })) << wrong;
  }
}

TEST(Navigation, IsUsableWithoutASpeedButNotWithAnInfiniteOne) {
  EXPECT_TRUE(is_usable_with([](Navigation& fix) { fix.speed = kUnknownSpeed; }));
  EXPECT_TRUE(is_usable_with([](Navigation& fix) { fix.speed = MetersPerSecond{-kNan}; }));
  EXPECT_FALSE(is_usable_with([](Navigation& fix) { fix.speed = MetersPerSecond{kInfinity}; }));
  EXPECT_FALSE(is_usable_with([](Navigation& fix) { fix.speed = MetersPerSecond{-kInfinity}; }));
  EXPECT_FALSE(is_usable_with([](Navigation& fix) { fix.speed = kUnknownSpeed, fix.depth = Meters{kNan}; }));
}

TEST(Navigation, IsOfNoUseWithANumberThatNoVehicleHas) {
  for (const double sign : {1.0, -1.0}) {
    EXPECT_TRUE(is_usable_with([sign](Navigation& fix) { fix.position = {.north = Meters{sign * 2e6}, .east = Meters{-sign * 2e6}}; }));
    EXPECT_FALSE(is_usable_with([sign](Navigation& fix) { fix.position.north = Meters{sign * 2.001e6}; }));
    EXPECT_FALSE(is_usable_with([sign](Navigation& fix) { fix.position.east = Meters{sign * 2.001e6}; }));
    EXPECT_TRUE(is_usable_with([sign](Navigation& fix) { fix.heading = Radians{sign * 1000}; }));
    EXPECT_FALSE(is_usable_with([sign](Navigation& fix) { fix.heading = Radians{sign * 1001}; }));
    EXPECT_TRUE(is_usable_with([sign](Navigation& fix) { fix.speed = MetersPerSecond{sign * 50}; }));
    EXPECT_FALSE(is_usable_with([sign](Navigation& fix) { fix.speed = MetersPerSecond{sign * 51}; }));
  }
  EXPECT_TRUE(is_usable_with([](Navigation& fix) { fix.depth = Meters{12'000}; }));
  EXPECT_FALSE(is_usable_with([](Navigation& fix) { fix.depth = Meters{12'001}; }));
  EXPECT_TRUE(is_usable_with([](Navigation& fix) { fix.depth = Meters{-100}; })) << "a pressure sensor that nobody zeroed";
  EXPECT_FALSE(is_usable_with([](Navigation& fix) { fix.depth = Meters{-101}; }));
}

}  // namespace
}  // namespace earshot::messages
