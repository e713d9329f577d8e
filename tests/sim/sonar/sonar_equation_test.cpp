#include "sim/sonar/sonar_equation.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace earshot::sonar {
namespace {

TEST(SonarEquation, GivesTenDecibelsAtNinetyOfLoss) {
  // The paper's source and noise: 190 - 90 - 90.
  EXPECT_EQ(signal_to_noise(Decibels{190.0}, Decibels{90.0}, Decibels{90.0}).value(), Decibels{10.0});
}

TEST(SonarEquation, RefusesWhatIsNotFinite) {
  const Decibels nan{std::numeric_limits<double>::quiet_NaN()};
  const Decibels infinite{std::numeric_limits<double>::infinity()};
  EXPECT_EQ(signal_to_noise(nan, Decibels{90.0}, Decibels{90.0}).status(), Status::kOutOfRange);
  EXPECT_EQ(signal_to_noise(Decibels{190.0}, infinite, Decibels{90.0}).status(), Status::kOutOfRange);
  EXPECT_EQ(signal_to_noise(infinite, infinite, Decibels{90.0}).status(), Status::kOutOfRange);
}

}  // namespace
}  // namespace earshot::sonar
