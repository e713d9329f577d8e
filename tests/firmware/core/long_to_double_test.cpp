// Times are counted in 64-bit integers and computed with in double: the conversion must round to the nearest, to even where two are as near
// (IEEE 754), also where a board brings its own (firmware/boards/cortex_m7/long_to_double.cpp).

#include <gtest/gtest.h>

#include <cstdint>
#include <limits>

namespace earshot {
namespace {

/// Not by the compiler.
template <class Integer>
double converted(Integer value) {
  const volatile Integer hidden = value;
  return static_cast<double>(hidden);
}

TEST(LongToDouble, IsExactUpToTwoToTheFiftyThird) {
  EXPECT_EQ(converted(std::int64_t{0}), 0.0);
  EXPECT_EQ(converted(std::int64_t{-1}), -1.0);
  EXPECT_EQ(converted(std::int64_t{4294967295}), 4294967295.0);
  EXPECT_EQ(converted(std::int64_t{-4294967297}), -4294967297.0);
  EXPECT_EQ(converted(std::int64_t{9007199254740991}), 9007199254740991.0);
  EXPECT_EQ(converted(std::int64_t{-9007199254740992}), -9007199254740992.0);
  EXPECT_EQ(converted(std::uint64_t{9007199254740991}), 9007199254740991.0);
}

TEST(LongToDouble, RoundsToTheNearestAndToEvenBetweenTwo) {
  EXPECT_EQ(converted(std::int64_t{9007199254740993}), 9007199254740992.0);    // 2^53 + 1, between 2^53 and 2^53 + 2
  EXPECT_EQ(converted(std::int64_t{9007199254740995}), 9007199254740996.0);    // 2^53 + 3
  EXPECT_EQ(converted(std::int64_t{-9007199254740993}), -9007199254740992.0);  // the same below 0
  EXPECT_EQ(converted(std::int64_t{-9007199254740995}), -9007199254740996.0);
  EXPECT_EQ(converted(std::int64_t{1152921504606847105}), 1152921504606847232.0);  // 2^60 + 129 of steps of 256: up
  EXPECT_EQ(converted(std::int64_t{1152921504606847104}), 1152921504606846976.0);  // 2^60 + 128: to even, down
  EXPECT_EQ(converted(std::int64_t{1152921504606847360}), 1152921504606847488.0);  // 2^60 + 384: to even, up
}

TEST(LongToDouble, HoldsTheGreatestAndTheLeast) {
  EXPECT_EQ(converted(std::numeric_limits<std::int64_t>::max()), 9223372036854775808.0);
  EXPECT_EQ(converted(std::numeric_limits<std::int64_t>::min()), -9223372036854775808.0);
  EXPECT_EQ(converted(std::numeric_limits<std::uint64_t>::max()), 18446744073709551616.0);
  EXPECT_EQ(converted(std::uint64_t{9223372036854775808U}), 9223372036854775808.0);
  EXPECT_EQ(converted(std::uint64_t{9223372036854777857U}), 9223372036854777856.0);  // 2^63 + 2049 of steps of 2048
}

}  // namespace
}  // namespace earshot
