#include "firmware/core/decibels.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "firmware/core/random.hpp"

namespace earshot {
namespace {

TEST(Log, IsWithinTenToTheMinusFifteenOfLongDouble) {
  Pcg32 random(6);
  const auto look = [](double x) {
    const long double exact = std::log(static_cast<long double>(x));
    const auto size = std::max(std::fabs(static_cast<double>(exact)), 0.1);
    ASSERT_NEAR(log(x), static_cast<double>(exact), 1e-15 * size) << x;
  };
  for (int i = 0; i < 100'000; ++i) {
    look(std::exp(1400.0 * random.uniform_double() - 700.0));
    look(0.5 + random.uniform_double());
  }
  look(std::numeric_limits<double>::denorm_min());
  look(std::numeric_limits<double>::max());
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
  EXPECT_EQ(exp(-701.0), 0.0);
  EXPECT_EQ(exp(701.0), std::numeric_limits<double>::infinity());
  EXPECT_TRUE(std::isnan(exp(std::numeric_limits<double>::quiet_NaN())));
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
