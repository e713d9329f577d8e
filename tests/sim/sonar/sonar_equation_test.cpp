#include "sim/sonar/sonar_equation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace earshot::sonar {
namespace {

TEST(SonarEquation, GivesTenDecibelsAtNinetyOfLoss) {
  // The paper's source and noise: 190 - 90 - 90.
  EXPECT_EQ(signal_to_noise(Decibels{190.0}, Decibels{90.0}, Decibels{90.0}), Decibels{10.0});
}

TEST(SonarEquation, HasNoValueWhereTheLossHasNone) {
  const Decibels nan{std::numeric_limits<double>::quiet_NaN()};
  EXPECT_TRUE(std::isnan(signal_to_noise(Decibels{190.0}, nan, Decibels{90.0}).value));
}

}  // namespace
}  // namespace earshot::sonar
