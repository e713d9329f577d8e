#include "firmware/wire/n2k/sensors/fields.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <initializer_list>
#include <string_view>
#include <vector>

#include "firmware/wire/n2k/codec.hpp"

namespace earshot::n2k {
namespace {

using Bytes = std::vector<std::uint8_t>;

struct Value {
  FieldName signal;
  double value;
};

Bytes message_with(std::uint32_t pgn, std::initializer_list<Value> values) {
  MessageWriter writer(pgn);
  for (const auto& [signal, value] : values) writer.set(signal, value);
  EXPECT_EQ(writer.status(), Status::kOk);
  return {writer.bytes().begin(), writer.bytes().end()};
}

/// 129029 at 46 N, 1.3 W, and behind its number of stations these bytes.
std::vector<std::uint8_t> position_with(std::uint8_t count, std::initializer_list<std::uint8_t> stations) {
  MessageWriter writer(kGnssPgn);
  writer.set("Latitude", 46.0).set("Longitude", -1.3).set("Method", 2).set("ReferenceStations", count);
  std::vector<std::uint8_t> bytes(writer.bytes().begin(), writer.bytes().end());
  bytes.insert(bytes.end(), stations);
  return bytes;
}

TEST(Fields, ReadTheReferenceStationsBehindTheirNumber) {
  // Type 2 and identifier 0x341 = 833 in one word, lowest byte first; 0x2710 = 10 000 hundredths of a second. Then one that says nothing.
  const auto two = fields::reference_stations(position_with(2, {0x12, 0x34, 0x10, 0x27, 0xFF, 0xFF, 0xFF, 0xFF}));
  ASSERT_TRUE(two.ok());
  ASSERT_EQ(two.value().size(), 2U);
  EXPECT_EQ(two.value()[0].type, 2);
  EXPECT_EQ(two.value()[0].id, 833);
  EXPECT_EQ(two.value()[0].age_s, 100.0);
  EXPECT_FALSE(two.value()[1].type || two.value()[1].id || two.value()[1].age_s);
  EXPECT_TRUE(fields::reference_stations(position_with(0, {})).value().empty());
  EXPECT_TRUE(fields::reference_stations(position_with(0, {1, 2, 3, 4})).value().empty()) << "padding";
  EXPECT_EQ(fields::reference_stations(position_with(2, {1, 2, 3, 4, 5, 6, 7})).status(), Status::kMalformed);
  EXPECT_EQ(fields::reference_stations(position_with(252, {})).status(), Status::kMalformed);
  std::vector<std::uint8_t> silent = position_with(1, {1, 2, 3, 4});
  silent[42] = 0xFF;
  EXPECT_EQ(fields::reference_stations(silent).status(), Status::kNotReady);
  silent.resize(42);
  EXPECT_EQ(fields::reference_stations(silent).status(), Status::kMalformed);
}

TEST(Fields, ReadAsManyReferenceStationsAsAMessageHolds) {
  Bytes bytes = position_with(45, {});
  bytes.resize(43 + 45 * 4, 0);
  const auto most = fields::reference_stations(bytes);
  ASSERT_TRUE(most.ok());
  EXPECT_EQ(most.value().size(), 45U);
}

TEST(Fields, ReadAGnssPositionByAnyMethodThatMeasuresOrIsNotSaid) {
  for (const int method : {1, 2, 3, 4, 5, 6}) {
    const auto place = fields::gnss_position(message_with(kGnssPgn, {{"Latitude", 46.0}, {"Longitude", -1.5}, {"Method", 1.0 * method}}));
    ASSERT_TRUE(place.ok()) << method;
    EXPECT_EQ(place.value().latitude_deg, 46.0);
    EXPECT_EQ(place.value().longitude_deg, -1.5);
  }
  EXPECT_TRUE(fields::gnss_position(message_with(kGnssPgn, {{"Latitude", 46.0}, {"Longitude", -1.5}})).ok());
  Bytes reserved = message_with(kGnssPgn, {{"Latitude", 46.0}, {"Longitude", -1.5}});
  reserved[31] = 0xEF;  // the method in the high four bits: 14, "out of range"
  EXPECT_EQ(fields::gnss_position(reserved).status(), Status::kOutOfRange);
}

TEST(Fields, LackAPlaceWithHalfOfIt) {
  EXPECT_EQ(fields::position(message_with(kPositionPgn, {{"Latitude", 46.0}})).status(), Status::kNotReady);
  EXPECT_EQ(fields::position(message_with(kPositionPgn, {{"Longitude", 1.0}})).status(), Status::kNotReady);
  // Nonsense goes before what is not there: 0x7FFFFFFE is "out of range", in either half.
  const Bytes bad_latitude{0xFE, 0xFF, 0xFF, 0x7F, 0xFF, 0xFF, 0xFF, 0x7F};
  const Bytes bad_longitude{0xFF, 0xFF, 0xFF, 0x7F, 0xFE, 0xFF, 0xFF, 0x7F};
  EXPECT_EQ(fields::position(bad_latitude).status(), Status::kOutOfRange);
  EXPECT_EQ(fields::position(bad_longitude).status(), Status::kOutOfRange);
}

TEST(Fields, OfACompassAreCorrectedByItsDeviationAndKeepItsVariation) {
  const auto magnetic =
      fields::heading(message_with(kHeadingPgn, {{"Heading", 3.0}, {"Deviation", -0.02}, {"Variation", 0.3}, {"Reference", 1}}));
  ASSERT_TRUE(magnetic.ok());
  EXPECT_NEAR(magnetic.value().value.value, 2.98, 1e-12);
  EXPECT_FALSE(magnetic.value().is_true);
  EXPECT_EQ(magnetic.value().variation->value, 0.3);
  const auto bare = fields::heading(message_with(kHeadingPgn, {{"Heading", 3.0}, {"Reference", 1}}));
  ASSERT_TRUE(bare.ok());
  EXPECT_EQ(bare.value().value.value, 3.0);
  EXPECT_FALSE(bare.value().variation.has_value());
  EXPECT_EQ(fields::heading(message_with(kHeadingPgn, {{"Heading", 3.0}})).status(), Status::kUnsupported) << "of an unknown reference";
  EXPECT_EQ(fields::heading(message_with(kHeadingPgn, {{"Reference", 0}})).status(), Status::kNotReady);
}

TEST(Fields, OfPressureAndTemperatureTellWaterFromTheRest) {
  const auto water = fields::pressure(message_with(kPressurePgn, {{"Source", 1}, {"Pressure", 1e5}}));
  ASSERT_TRUE(water.ok());
  EXPECT_TRUE(water.value().is_water);
  EXPECT_EQ(water.value().value, 1e5);
  EXPECT_FALSE(fields::pressure(message_with(kPressurePgn, {{"Source", 0}, {"Pressure", 1e5}})).value().is_water);
  EXPECT_FALSE(fields::pressure(message_with(kPressurePgn, {{"Source", 0}})).value().is_water) << "whether it has a value or not";
  EXPECT_EQ(fields::pressure(message_with(kPressurePgn, {{"Source", 1}})).status(), Status::kNotReady);
  EXPECT_EQ(fields::pressure(message_with(kPressurePgn, {{"Pressure", 1e5}})).status(), Status::kUnsupported) << "of nobody knows what";
  Bytes reserved = message_with(kPressurePgn, {{"Pressure", 1e5}});
  reserved[2] = 0xFE;
  EXPECT_EQ(fields::pressure(reserved).status(), Status::kOutOfRange);
  const auto sea = fields::temperature(message_with(kTemperaturePgn, {{"Source", 0}, {"ActualTemperature", 280.15}}));
  ASSERT_TRUE(sea.ok());
  EXPECT_TRUE(sea.value().is_water);
  EXPECT_EQ(sea.value().value, 280.15);
}

TEST(Fields, OfAttitudeAndCourseNeedBothTheirHalves) {
  EXPECT_EQ(fields::attitude(message_with(kAttitudePgn, {{"Pitch", 0.1}})).status(), Status::kNotReady);
  EXPECT_EQ(fields::attitude(message_with(kAttitudePgn, {{"Roll", 0.1}})).status(), Status::kNotReady);
  EXPECT_EQ(fields::over_ground(message_with(kCoursePgn, {{"COGReference", 0}, {"COG", 1}})).status(), Status::kNotReady);
  EXPECT_EQ(fields::over_ground(message_with(kCoursePgn, {{"COGReference", 0}, {"SOG", 1}})).status(), Status::kNotReady);
  const auto over_ground = fields::over_ground(message_with(kCoursePgn, {{"COGReference", 0}, {"COG", 1.5}, {"SOG", 2}}));
  ASSERT_TRUE(over_ground.ok());
  EXPECT_EQ(over_ground.value().course.value, 1.5);
  EXPECT_EQ(over_ground.value().speed.value, 2.0);
}

TEST(Fields, OfABatteryAreTheOnesThatItHas) {
  const auto all = fields::battery(message_with(kBatteryPgn, {{"Voltage", 24.5}, {"Current", -3.5}, {"Temperature", 290}}));
  ASSERT_TRUE(all.ok());
  EXPECT_EQ(all.value().voltage_v, 24.5);
  EXPECT_EQ(all.value().current_a, -3.5);
  EXPECT_EQ(all.value().temperature_k, 290.0);
  EXPECT_EQ(fields::battery(message_with(kBatteryPgn, {{"Current", -3.5}})).value().current_a, -3.5);
  EXPECT_EQ(fields::battery(message_with(kBatteryPgn, {{"Temperature", 290}})).value().temperature_k, 290.0);
  EXPECT_EQ(fields::battery(message_with(kBatteryPgn, {{"Instance", 0}})).status(), Status::kNotReady);
  EXPECT_EQ(fields::battery(Bytes(2, 0)).status(), Status::kMalformed);
}

TEST(Fields, OfAChargeArePercentOfABatteryAndNothingOfAnotherSource) {
  // Type at byte 2, charge at byte 3, 11 bytes.
  const auto bytes = [](std::uint8_t type, std::uint8_t percent) {
    return Bytes{0xFF, 7, type, percent, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF};
  };
  EXPECT_EQ(fields::charge(bytes(0, 73)).value(), 73.0);
  EXPECT_EQ(fields::charge(bytes(0, 0)).value(), 0.0);
  EXPECT_EQ(fields::charge(bytes(0, 100)).value(), 100.0);
  EXPECT_EQ(fields::charge(bytes(0, 101)).status(), Status::kOutOfRange);
  EXPECT_EQ(fields::charge(bytes(0, 0xFE)).status(), Status::kOutOfRange);
  EXPECT_EQ(fields::charge(bytes(0, 0xFF)).status(), Status::kNotReady);
  EXPECT_FALSE(fields::charge(bytes(3, 73)).value().has_value()) << "a solar cell";
  EXPECT_EQ(fields::charge(bytes(0xFF, 73)).status(), Status::kUnsupported) << "of what it does not say";
  EXPECT_EQ(fields::charge_instance(bytes(0, 73)), 7);
}

TEST(Fields, OfEverySensorOfSeveralHaveTheirInstance) {
  EXPECT_EQ(fields::rudder_instance(message_with(kRudderPgn, {{"Instance", 3}})), 3);
  EXPECT_EQ(fields::pressure_instance(message_with(kPressurePgn, {{"Instance", 4}})), 4);
  EXPECT_EQ(fields::temperature_instance(message_with(kTemperaturePgn, {{"Instance", 5}})), 5);
  EXPECT_EQ(fields::battery_instance(message_with(kBatteryPgn, {{"Instance", 6}})), 6);
  EXPECT_FALSE(fields::battery_instance(message_with(kBatteryPgn, {})).has_value());
}

}  // namespace
}  // namespace earshot::n2k
