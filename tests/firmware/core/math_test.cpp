#include "firmware/core/math.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

#include "firmware/core/crc32.hpp"
#include "firmware/core/random.hpp"

namespace earshot {
namespace {

// The oracle is the C library's long double, good to 64 bits, rounded once.

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr double kPi = 3.14159265358979323846;

/// |got - exact| in units of the last place of the float next to `exact`.
long double ulps(float got, long double exact) {
  const float size = std::fabs(static_cast<float>(exact));
  const float ulp = std::nextafter(size, kInfinity) - size;
  return std::fabs(static_cast<long double>(got) - exact) / static_cast<long double>(ulp);
}

/// Calls `visit` with about `count` floats of either sign, spread evenly over all exponents up to `largest`.
template <class Visit>
void for_floats_up_to(float largest, Visit visit) {
  for (std::uint32_t bits = 0; bits <= std::bit_cast<std::uint32_t>(largest); bits += 2503) {
    visit(std::bit_cast<float>(bits));
    visit(-std::bit_cast<float>(bits));
  }
}

TEST(Exp, IsWithinHalfAnUlpOfLongDouble) {
  long double worst = 0.0L;
  for_floats_up_to(88.72F, [&worst](float x) { worst = std::max(worst, ulps(exp(x), std::exp(static_cast<long double>(x)))); });
  EXPECT_LE(worst, 0.501L);  // measured 0.4999...; the last place of subnormal results is that of the subnormals
}

TEST(Exp, OverflowsToInfinityAndUnderflowsToZero) {
  EXPECT_EQ(exp(88.73F), kInfinity);  // ln of the largest float is 88.7228
  EXPECT_EQ(exp(1'000.0F), kInfinity);
  EXPECT_EQ(exp(3e38F), kInfinity);
  EXPECT_EQ(exp(kInfinity), kInfinity);
  EXPECT_EQ(exp(-104.0F), 0.0F);  // ln of half the smallest subnormal is -103.97
  EXPECT_EQ(exp(-1'000.0F), 0.0F);
  EXPECT_EQ(exp(-kInfinity), 0.0F);
  EXPECT_EQ(exp(0.0F), 1.0F);
  EXPECT_TRUE(std::isnan(exp(kNan)));
}

TEST(SineCosine, IsWithinFourTimesTenToTheMinusSixteenOfLongDouble) {
  Pcg32 random(1);
  for (int i = 0; i < 300000; ++i) {
    const double angle = kPi * (2.0 * random.uniform_double() - 1.0);
    const SineCosine got = sine_cosine(Radians{angle});
    ASSERT_NEAR(got.sine, static_cast<double>(std::sin(static_cast<long double>(angle))), 4e-16) << angle;
    ASSERT_NEAR(got.cosine, static_cast<double>(std::cos(static_cast<long double>(angle))), 4e-16) << angle;
  }
}

TEST(SineCosine, OfManyTurnsLosesNoMoreThanTheAnglesOwnRounding) {
  for (const double angle : {7.0, -100.0, 1e4, -1e6, 1e9}) {
    const SineCosine got = sine_cosine(Radians{angle});
    const double tolerance = 4e-16 + 4e-17 * std::fabs(angle);  // as the docstring promises
    EXPECT_NEAR(got.sine, static_cast<double>(std::sin(static_cast<long double>(angle))), tolerance) << angle;
    EXPECT_NEAR(got.cosine, static_cast<double>(std::cos(static_cast<long double>(angle))), tolerance) << angle;
  }
}

TEST(SineCosine, StaysOnTheUnitCircleForTheLargestDouble) {
  const SineCosine got = sine_cosine(Radians{std::numeric_limits<double>::max()});
  EXPECT_NEAR(got.sine * got.sine + got.cosine * got.cosine, 1.0, 1e-15);  // two roundings each
}

TEST(SineCosine, OfInfinityIsNan) {
  EXPECT_TRUE(std::isnan(sine_cosine(Radians{std::numeric_limits<double>::infinity()}).sine));
  EXPECT_TRUE(std::isnan(sine_cosine(Radians{std::numeric_limits<double>::infinity()}).cosine));
}

TEST(BearingOf, IsWithinTenToTheMinusFifteenOfLongDouble) {
  Pcg32 random(1);
  for (int i = 0; i < 300000; ++i) {
    const double north = 2.0 * random.uniform_double() - 1.0;
    const double east = 2.0 * random.uniform_double() - 1.0;
    const auto exact = static_cast<double>(std::atan2(static_cast<long double>(east), static_cast<long double>(north)));
    ASSERT_NEAR(bearing_of(north, east).value, exact, 1e-15) << north << ' ' << east;
  }
}

TEST(BearingOf, TheEightCompassPointsIsExact) {
  EXPECT_EQ(bearing_of(1, 0).value, 0.0);
  EXPECT_EQ(bearing_of(1, 1).value, kPi / 4);
  EXPECT_EQ(bearing_of(0, 1).value, kPi / 2);
  EXPECT_EQ(bearing_of(-1, 1).value, kPi - kPi / 4);
  EXPECT_EQ(bearing_of(-1, 0).value, kPi);
  EXPECT_EQ(bearing_of(-1, -0.0).value, kPi);
  EXPECT_EQ(bearing_of(-1, -1e-17).value, kPi) << "less than half an ulp beyond";
  EXPECT_EQ(bearing_of(-1, -1).value, -(kPi - kPi / 4));
  EXPECT_EQ(bearing_of(0, -1).value, -kPi / 2);
  EXPECT_EQ(bearing_of(1, -1).value, -kPi / 4);
}

TEST(BearingOf, TheZeroVectorIsNorthAndOfNanIsNan) {
  EXPECT_EQ(bearing_of(0, 0).value, 0.0);
  EXPECT_TRUE(std::isnan(bearing_of(std::numeric_limits<double>::quiet_NaN(), 1).value));
  EXPECT_TRUE(std::isnan(bearing_of(1, std::numeric_limits<double>::quiet_NaN()).value));
}

TEST(BearingOf, AnInfiniteVectorIsThatOfItsInfiniteAxisAndOfTwoNone) {
  EXPECT_EQ(bearing_of(5, kInfinity).value, kPi / 2);
  EXPECT_EQ(bearing_of(-kInfinity, 5).value, kPi);
  EXPECT_TRUE(std::isnan(bearing_of(kInfinity, -kInfinity).value));
}

TEST(BearingOf, UndoesSineAndCosine) {
  for (double angle = -3.14; angle < 3.14; angle += 0.01) {
    const SineCosine direction = sine_cosine(Radians{angle});
    EXPECT_NEAR(bearing_of(direction.cosine, direction.sine).value, angle, 1.5e-15);  // the sum of both functions' errors
  }
}

TEST(WrapToPi, LeavesAnAngleInRangeAsItIs) {
  for (const double angle : {kPi, 3.0, 0.1, 0.0, -0.1, -3.0, -3.1415926535897927}) EXPECT_EQ(wrap_to_pi(Radians{angle}).value, angle);
}

TEST(WrapToPi, TakesOffWholeTurns) {
  EXPECT_EQ(wrap_to_pi(Radians{-kPi}).value, kPi);
  EXPECT_EQ(wrap_to_pi(Radians{3 * kPi}).value, kPi);
  EXPECT_EQ(wrap_to_pi(Radians{-3 * kPi}).value, kPi);
  EXPECT_EQ(wrap_to_pi(Radians{2 * kPi}).value, 0.0);
  EXPECT_NEAR(wrap_to_pi(Radians{4.0}).value, 4.0 - 2 * kPi, 1e-15);      // one rounding near 4
  EXPECT_NEAR(wrap_to_pi(Radians{-4.0}).value, 2 * kPi - 4.0, 1e-15);     // likewise
  EXPECT_NEAR(wrap_to_pi(Radians{1.0 + 200 * kPi}).value, 1.0, 1.2e-13);  // the argument's own last place at 629
}

TEST(WrapToPi, OfWhatIsNotFiniteIsNan) {
  EXPECT_TRUE(std::isnan(wrap_to_pi(Radians{std::numeric_limits<double>::infinity()}).value));
  EXPECT_TRUE(std::isnan(wrap_to_pi(Radians{std::numeric_limits<double>::quiet_NaN()}).value));
}

TEST(Sqrt, IsCorrectlyRounded) {
  EXPECT_EQ(sqrt(25.0), 5.0);
  EXPECT_EQ(sqrt(2.0), 1.4142135623730951);  // the double next to the root
  EXPECT_TRUE(std::isnan(sqrt(-1.0)));
}

TEST(IsFinite, TellsNanAndBothInfinitiesFromTheLargestNumbers) {
  EXPECT_FALSE(is_finite(std::numeric_limits<double>::quiet_NaN()));
  EXPECT_FALSE(is_finite(-std::numeric_limits<double>::infinity()));
  EXPECT_TRUE(is_finite(std::numeric_limits<double>::lowest()));
  EXPECT_TRUE(is_finite(std::numeric_limits<double>::denorm_min()));
  EXPECT_FALSE(is_finite(kNan));
  EXPECT_FALSE(is_finite(kInfinity));
  EXPECT_TRUE(is_finite(std::numeric_limits<float>::max()));
}

TEST(IsFinite, KnowsANanByEveryBitThatMakesOne) {
  for (std::uint64_t bit = 0; bit < 52; ++bit)
    EXPECT_FALSE(is_finite(std::bit_cast<double>(0x7FF0000000000000U | std::uint64_t{1} << bit)));
  for (std::uint32_t bit = 0; bit < 23; ++bit) EXPECT_FALSE(is_finite(std::bit_cast<float>(0x7F800000U | std::uint32_t{1} << bit)));
}

TEST(IsFinite, TakesANumberWithAnyOneBitOfAnInfinityMissing) {
  for (std::uint64_t bit = 52; bit < 63; ++bit)
    EXPECT_TRUE(is_finite(std::bit_cast<double>(0x7FFFFFFFFFFFFFFFU ^ std::uint64_t{1} << bit)));
  for (std::uint32_t bit = 23; bit < 31; ++bit) EXPECT_TRUE(is_finite(std::bit_cast<float>(0x7FFFFFFFU ^ std::uint32_t{1} << bit)));
}

/// Checksum of the bits of many results, the same on every machine. Arguments are exact, so that contraction in the test itself changes
/// nothing.
std::uint32_t checksum_of_many_results() {
  std::uint32_t crc = 0;
  const auto add = [&crc](auto value) {
    const auto bytes = std::bit_cast<std::array<std::uint8_t, sizeof(value)>>(value);
    crc = crc32(bytes, crc);
  };
  Pcg32 random(3);
  for (int i = 0; i < 20000; ++i) {
    const double x = 16.0 * random.uniform_double() - 8.0;
    const double y = 16.0 * random.uniform_double() - 8.0;
    add(exp(static_cast<float>(x)));
    add(sine_cosine(Radians{x}).sine);
    add(sine_cosine(Radians{x}).cosine);
    add(bearing_of(x, y).value);
    add(sqrt(x * x));
  }
  return crc;
}

TEST(Math, GivesTheSameBitsOnEveryMachine) {
  EXPECT_EQ(checksum_of_many_results(), 0xB2EFB773U);  // GCC 12 at -O0 and -O3, x86-64, aarch64 and 32-bit ARM alike
}

TEST(Bounds, AreTheLesserAndTheGreaterOfTwo) {
  EXPECT_EQ(lesser(1.0F, 2.0F), 1.0F);
  EXPECT_EQ(lesser(2.0F, 1.0F), 1.0F);
  EXPECT_EQ(lesser(-1.0F, -1.0F), -1.0F);
  EXPECT_EQ(greater(1.0F, 2.0F), 2.0F);
  EXPECT_EQ(greater(2.0F, 1.0F), 2.0F);
  EXPECT_EQ(greater(-std::numeric_limits<float>::infinity(), 3.0F), 3.0F);
  EXPECT_EQ(lesser(std::numeric_limits<float>::quiet_NaN(), 3.0F), 3.0F);
  EXPECT_EQ(greater(std::numeric_limits<float>::quiet_NaN(), 3.0F), 3.0F);
}

}  // namespace
}  // namespace earshot
