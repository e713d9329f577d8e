#include "firmware/core/random.hpp"

#include <gtest/gtest.h>

namespace earshot {
namespace {

TEST(Pcg32, GivesThePublishedSequenceOfSeed42Stream54) {
  Pcg32 random(42, 54);
  // First numbers of the reference implementation's demonstration (pcg32-demo of pcg-c-basic).
  for (const std::uint32_t expected : {0xa15c02b7U, 0x7b47f409U, 0xba1d3330U, 0x83d2f293U, 0xbfa4784bU, 0xcbed606eU}) {
    EXPECT_EQ(random.next(), expected);
  }
}

TEST(Pcg32, UniformFloatIsTheTopTwentyFourBits) {
  Pcg32 random(42, 54);
  EXPECT_EQ(random.uniform_float(), static_cast<float>(0xa15c02) / 16777216.0F);
}

TEST(Pcg32, UniformDoubleIsTheTopBitsOfTwoNumbers) {
  Pcg32 random(42, 54);
  const double expected = (static_cast<double>(0xa15c02b7U >> 5U) * 67108864.0 + (0x7b47f409U >> 6U)) / 9007199254740992.0;
  EXPECT_EQ(random.uniform_double(), expected);
}

TEST(Pcg32, UniformNumbersFillTheUnitIntervalEvenly) {
  Pcg32 random(7);
  double sum = 0.0;
  constexpr int kCount = 100000;
  for (int i = 0; i < kCount; ++i) {
    const float u = random.uniform_float();
    ASSERT_GE(u, 0.0F);
    ASSERT_LT(u, 1.0F);
    sum += double{u};
  }
  EXPECT_NEAR(sum / kCount, 0.5, 0.005);  // five standard deviations of the mean, 0.2887 / sqrt(100000)
}

TEST(Pcg32, GoesOnFromItsState) {
  Pcg32 random(42, 54);
  static_cast<void>(random.next());
  Pcg32 again(random.state());
  EXPECT_EQ(again.next(), 0x7b47f409U);  // the second of the published sequence
  EXPECT_EQ(random.next(), 0x7b47f409U);
  EXPECT_EQ(again.state(), random.state());
}

TEST(Pcg32, StreamsOfOneSeedDiffer) {
  Pcg32 first(1, 0);
  Pcg32 second(1, 1);
  EXPECT_NE(first.next(), second.next());
}

}  // namespace
}  // namespace earshot
