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

}  // namespace
}  // namespace earshot::messages
