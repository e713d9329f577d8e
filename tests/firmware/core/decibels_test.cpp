#include "firmware/core/decibels.hpp"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include "firmware/core/crc32.hpp"
#include "firmware/core/random.hpp"

namespace earshot {
namespace {

TEST(Log, IsWithinTenToTheMinusFifteenOfLongDouble) {
  Pcg32 random(6);
  const auto visit = [](double x) {
    const long double exact = std::log(static_cast<long double>(x));
    const auto size = std::max(std::fabs(static_cast<double>(exact)), 0.1);
    ASSERT_NEAR(log(x), static_cast<double>(exact), 1e-15 * size) << x;
  };
  for (int i = 0; i < 100'000; ++i) {
    visit(std::exp(1400.0 * random.uniform_double() - 700.0));
    visit(0.5 + random.uniform_double());
  }
  visit(std::numeric_limits<double>::denorm_min());
  visit(std::numeric_limits<double>::max());
  EXPECT_EQ(log(1.0), 0.0);
}

TEST(Log, HasNoneOfWhatIsNotPositive) {
  EXPECT_EQ(log(0.0), -std::numeric_limits<double>::infinity());
  EXPECT_TRUE(std::isnan(log(-1.0)));
  EXPECT_TRUE(std::isnan(log(std::numeric_limits<double>::quiet_NaN())));
  EXPECT_EQ(log(std::numeric_limits<double>::infinity()), std::numeric_limits<double>::infinity());
}

TEST(ExpOfDouble, IsWithinTenToTheMinusFifteenOfLongDouble) {
  Pcg32 random(7);
  for (int i = 0; i < 100'000; ++i) {
    const double x = 1400.0 * random.uniform_double() - 700.0;
    const auto exact = static_cast<double>(std::exp(static_cast<long double>(x)));
    ASSERT_NEAR(exp(x), exact, 1e-15 * exact) << x;
  }
  EXPECT_NEAR(exp(700.0), 1.0142320547350045e304, 1e289);  // e^700 and e^-700 of tables, good to 1e-15
  EXPECT_NEAR(exp(-700.0), 9.859676543759770e-305, 1e-319);
  EXPECT_EQ(exp(-701.0), 0.0);
  EXPECT_EQ(exp(701.0), std::numeric_limits<double>::infinity());
  EXPECT_TRUE(std::isnan(exp(std::numeric_limits<double>::quiet_NaN())));
}

/// Of the very last bits, which no tolerance sees: detections and beliefs are made of them, and a replay has to come to the same.
TEST(LogAndExpOfDouble, GiveTheSameBitsOnEveryMachine) {
  std::uint32_t crc = 0;
  const auto add = [&crc](double value) { crc = crc32(std::bit_cast<std::array<std::uint8_t, 8>>(value), crc); };
  Pcg32 random(8);
  for (int i = 0; i < 20'000; ++i) {
    const double x = 64.0 * random.uniform_double();
    add(exp(x - 32.0));
    add(log(x));
  }
  for (int k = -30; k <= 30; ++k) add(log(std::ldexp(0x1.6a09e667f3bcdp-1, k)));  // where the halves of log's interval meet
  EXPECT_EQ(crc, 0x0D05D408U);  // x86-64: GCC 12 at -O0 and at -O3 with and without AVX2, clang 16
}

TEST(LevelOf, IsTenTimesTheDecimalLogarithm) {
  EXPECT_NEAR(level_of(1000.0).value, 30.0, 1e-13);
  EXPECT_NEAR(level_of(2.0).value, 3.010299956639812, 1e-15);  // by hand
  EXPECT_EQ(level_of(1.0).value, 0.0);
}

TEST(PowerOf, UndoesLevelOf) {
  EXPECT_NEAR(power_of(Decibels{-37.0}), 1.9952623149688795e-4, 1e-18);  // by hand
  for (const double power : {1e-18, 3.7, 1e21}) EXPECT_NEAR(power_of(level_of(power)), power, 2e-14 * power);
}

}  // namespace
}  // namespace earshot
