#include "policy/explain/wording.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sim/search/actions/compass_directions.hpp"
#include "sim/search/settings.hpp"

namespace earshot::explain {
namespace {

using policy::Feature;

Radians degrees(double value) {
  return Radians{value * std::numbers::pi / 180.0};
}

TEST(UsesMeasurements, IsTrueOfAnObservationWithAnSnrOrABeliefAndFalseOfPlaceAndSteps) {
  policy::ObservationSpec spec;
  for (const Feature feature : {Feature::kEast, Feature::kStepNorth, Feature::kToWestEdge}) (void)spec.push_back({.feature = feature});
  EXPECT_FALSE(uses_measurements(spec));
  for (const Feature feature : {Feature::kStepSnr, Feature::kLikeliestEast, Feature::kPreference}) {
    policy::ObservationSpec measuring = spec;
    (void)measuring.push_back({.feature = feature});
    EXPECT_TRUE(uses_measurements(measuring)) << static_cast<int>(feature);
  }
}

TEST(FactorToString, IsInDigitsAsFarAsTheyCanBeReadAndInPowersOfTenBeyond) {
  EXPECT_EQ(factor_to_string(std::log(1.826)), "\u00D7 1.83");
  EXPECT_EQ(factor_to_string(std::log(20'400.0)), "\u00D7 20\u202F000");
  EXPECT_EQ(factor_to_string(std::log(170.0)), "\u00D7 170");
  EXPECT_EQ(factor_to_string(std::log(0.00213)), "\u00D7 0.0021");
  EXPECT_EQ(factor_to_string(std::log(7.4e7)), "\u00D7 7.4\u00B710\u2077");
  EXPECT_EQ(factor_to_string(std::log(3.2e-12)), "\u00D7 3.2\u00B710\u207B\u00B9\u00B2");
}

TEST(DirectionName, IsThePointOfTheCompassWhereItIsOneAndDegreesWhereNot) {
  const auto names = [](std::size_t count) {
    std::string text;
    for (const UnitNorthEast& direction : search::compass_directions(count)) text += direction_name(direction) + " ";
    return text;
  };
  EXPECT_EQ(names(4), "N E S W ");
  EXPECT_EQ(names(8), "N NE E SE S SW W NW ");
  EXPECT_EQ(names(16), "N NNE NE ENE E ESE SE SSE S SSW SW WSW W WNW NW NNW ");
  EXPECT_EQ(names(5), "N 072\u00B0 144\u00B0 216\u00B0 288\u00B0 ");
}

TEST(DegreesInWords, GoFromNorthOnceAroundAndBegin) {
  EXPECT_EQ(degrees_to_string(degrees(0.0)), "000\u00B0");
  EXPECT_EQ(degrees_to_string(degrees(14.4)), "014\u00B0");
  EXPECT_EQ(degrees_to_string(degrees(359.4)), "359\u00B0");
  EXPECT_EQ(degrees_to_string(degrees(359.7)), "000\u00B0");
  EXPECT_EQ(degrees_to_string(degrees(-0.3)), "000\u00B0");
  EXPECT_EQ(degrees_to_string(degrees(-90.0)), "270\u00B0");
  const double west_of_north = -0.3 * std::numbers::pi / 180.0;
  EXPECT_EQ(direction_name({std::cos(west_of_north), std::sin(west_of_north)}), "000\u00B0");
}

TEST(ValueOf, UndoesTheScalingOfTheObservation) {
  const policy::ObservationElement snr{.feature = Feature::kStepSnr, .age = 0, .offset = 10.0F, .scale = 0.5F};
  EXPECT_EQ(value_of(snr, -1.25F), "7.5 dB");  // -1.25 / 0.5 + 10
  const policy::ObservationElement east{.feature = Feature::kEast, .age = 0, .offset = 12'500.0F, .scale = 1.0F / 12'500.0F};
  EXPECT_EQ(value_of(east, -1.0F), "0.00 km");
  EXPECT_EQ(value_of(east, 0.2F), "15.00 km");
  const policy::ObservationElement found{.feature = Feature::kFound, .age = 2, .offset = 0.0F, .scale = 4.0F};
  EXPECT_EQ(value_of(found, 1.0F), "25.0 %");
  EXPECT_EQ(value_of({.feature = Feature::kFindProbability, .age = 2, .offset = 0.0F, .scale = 4.0F}, 1.0F), "25.0 %");
}

TEST(NameOf, TellsEveryFeatureOfABeliefAndEveryDirectionFromEveryOther) {
  const search::ActionTable actions = search::compass_directions(8);
  std::vector<std::string> names;
  for (int feature = 0; feature < 64; ++feature) {
    if (!policy::is_known(static_cast<Feature>(feature))) continue;
    for (std::uint8_t age = 0; age < 2; ++age) {
      const policy::ObservationElement element{.feature = static_cast<Feature>(feature), .age = age};
      const std::string name = name_of(element, actions);
      EXPECT_EQ(name.find("feature"), std::string::npos) << "no words for feature " << feature;
      if (age == 0 || name != names.back()) names.push_back(name);
    }
  }
  const std::size_t count = names.size();
  std::ranges::sort(names);
  names.erase(std::unique(names.begin(), names.end()), names.end());
  EXPECT_EQ(names.size(), count);
}

TEST(Fixed, NeverWritesMinusZero) {
  EXPECT_EQ(fixed(-0.004, 2), "0.00");
  EXPECT_EQ(fixed(-0.006, 2), "-0.01");
  EXPECT_EQ(fixed(0.0, 0), "0");
  EXPECT_EQ(fixed(-10.0, 0), "-10");
}

TEST(CompassPoint, IsTheNearestOfTheSixteen) {
  const auto point = [](double degrees) { return compass_point(Radians{degrees * std::numbers::pi / 180.0}); };
  EXPECT_EQ(point(205.0), "SSW");
  EXPECT_EQ(point(359.0), "N");
  EXPECT_EQ(point(-45.0), "NW");
  EXPECT_EQ(point(33.7), "NNE");
  EXPECT_EQ(point(33.8), "NE");
}

}  // namespace
}  // namespace earshot::explain
