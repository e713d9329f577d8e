#include "firmware/policy/ocean_belief/measurement_history.hpp"

#include <gtest/gtest.h>

namespace earshot::policy {
namespace {

NorthEast at(double north_m, double east_m) {
  return {Meters{north_m}, Meters{east_m}};
}

Measurement measured_at(NorthEast place) {
  return measurement_of(place, {.snr = Decibels{3.0}});
}

TEST(PastBearing, IsThereOnlyWhereOneWasMeasured) {
  EXPECT_FALSE(PastBearing().is_there());
  EXPECT_FALSE(PastBearing(std::nullopt).is_there());
  EXPECT_TRUE(PastBearing(messages::Bearing{.direction = Radians{0.0}, .deviation = Radians{1e-3}}).is_there());
}

TEST(PastBearing, GivesBackWhatSinglePrecisionHolds) {
  const messages::Bearing measured{.direction = Radians{1.25}, .deviation = Radians{0.0625}, .mirror_axis = Radians{0.5}};
  EXPECT_EQ(PastBearing(measured).bearing(), measured) << "a float holds each of these";
}

TEST(PastBearing, MirrorsADirectionIntoItselfWhereNothingIsMirrored) {
  const messages::Bearing measured{.direction = Radians{1.25}, .deviation = Radians{0.0625}};
  EXPECT_EQ(PastBearing(measured).bearing().mirror_axis, Radians{1.25});
}

TEST(MeasurementHistory, KeepsMeasurementsInTheirOrder) {
  MeasurementHistory history;
  EXPECT_EQ(history.add(measured_at(at(1, 2))), 0U);
  EXPECT_EQ(history.add(measurement_of(at(3, 4), {.snr = Decibels{-5.0}, .too_faint = true})), 1U);
  EXPECT_EQ(history.count(), 2U);
  EXPECT_TRUE(history.is_whole());
  ASSERT_EQ(history.measurements().size(), 2U);
  EXPECT_EQ(history.measurements()[0].position, at(1, 2));
  EXPECT_FALSE(history.measurements()[0].too_faint);
  EXPECT_EQ(history.measurements()[1].snr, Decibels{-5.0});
  EXPECT_TRUE(history.measurements()[1].too_faint);
}

TEST(MeasurementHistory, MarksTheLastMeasurementAsDeclared) {
  MeasurementHistory history;
  history.mark_declared();
  history.add(measured_at({}));
  history.add(measured_at({}));
  history.mark_declared();
  EXPECT_FALSE(history.measurements()[0].was_declared);
  EXPECT_TRUE(history.measurements()[1].was_declared);
}

TEST(MeasurementHistory, CountsOnWhereAMeasurementNoLongerFits) {
  MeasurementHistory history;
  for (std::size_t i = 0; i < config::kMaxBeliefMeasurements; ++i) history.add(measured_at({}));
  EXPECT_TRUE(history.is_whole());
  EXPECT_EQ(history.add(measured_at(at(7, 7))), config::kMaxBeliefMeasurements);
  EXPECT_FALSE(history.is_whole());
  EXPECT_EQ(history.count(), config::kMaxBeliefMeasurements + 1);
  EXPECT_EQ(history.measurements().size(), config::kMaxBeliefMeasurements);
  history.mark_declared();
  for (const Measurement& measurement : history.measurements()) EXPECT_FALSE(measurement.was_declared) << "the last is not kept";
  history.start();
  EXPECT_TRUE(history.is_whole());
  EXPECT_EQ(history.count(), 0U);
  EXPECT_TRUE(history.measurements().empty());
}

TEST(MeasurementHistory, CountsVisitsWithinARange) {
  MeasurementHistory history;
  for (const NorthEast place : {at(0, 0), at(30, 40), at(0, 51), at(0, 49), at(-49, 0)}) history.add(measured_at(place));
  EXPECT_EQ(history.visits(at(0, 0), Meters{50.0}), 3U) << "without the one at 50 m";
}

}  // namespace
}  // namespace earshot::policy
