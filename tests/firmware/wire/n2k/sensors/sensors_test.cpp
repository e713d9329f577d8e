#include "firmware/wire/n2k/sensors/sensors.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <initializer_list>
#include <vector>

#include "firmware/wire/n2k/codec.hpp"

namespace earshot::n2k {
namespace {

constexpr Time kNow{1'000'000'000};
constexpr std::uint8_t kA = 10;
constexpr std::uint8_t kB = 11;
constexpr Name kNameOfA = 0xC050'9635'E772'EE1F;  // of tests/reference/n2k/frames.txt, source 204
constexpr Name kNameOfB = 0xC0A0'961C'E76F'E09D;  // likewise, source 0
constexpr double kTrue = 0;
constexpr double kMagnetic = 1;

struct Value {
  FieldName signal;
  double value;
};

Frame frame_of(std::uint32_t pgn, std::initializer_list<Value> values, std::uint8_t source = kA) {
  MessageWriter writer(pgn);
  for (const auto& [signal, value] : values) writer.set(signal, value);
  Frame frame;
  EXPECT_EQ(writer.frame(source, frame), Status::kOk);
  return frame;
}

Frame claim_of(Name name, std::uint8_t source) {
  Frame frame{.identifier = 0x18EEFF00U | source};
  for (unsigned i = 0; i < 8; ++i) frame.data[i] = static_cast<std::uint8_t>(name >> (8 * i));
  return frame;
}

class SensorsTest : public ::testing::Test {
 protected:
  Status accept(const Frame& frame, Time now = kNow) { return sensors_.accept(frame, now, measured_); }
  Status heading(double value, double reference, std::uint8_t source = kA, Time now = kNow) {
    return accept(frame_of(kHeadingPgn, {{"Heading", value}, {"Reference", reference}}, source), now);
  }
  [[nodiscard]] const Readings& readings() const { return sensors_.readings(); }
  void choose(Measured measured, const SourceChoice& choice) {
    SensorSettings settings;
    settings.sources[static_cast<std::size_t>(measured)] = choice;
    sensors_ = Sensors(settings);
  }

  Sensors sensors_;
  Measured measured_{};
};

TEST_F(SensorsTest, RefuseAMagneticHeadingWithoutAVariation) {
  EXPECT_EQ(heading(1.0, kMagnetic), Status::kUnsupported);
  EXPECT_FALSE(readings().heading.has_value());
  EXPECT_EQ(sensors_.counters().no_variation, 1U);
  EXPECT_EQ(heading(1.0, 2.0), Status::kUnsupported) << "Error";
}

TEST_F(SensorsTest, MakeAMagneticHeadingTrueWithAYoungVariation) {
  // East is positive: 2.3152 + 0.1 rad.
  ASSERT_EQ(accept(frame_of(kVariationPgn, {{"Variation", 0.1}})), Status::kOk);
  const Time last = kNow + Duration::seconds(10);
  ASSERT_EQ(heading(2.3152, kMagnetic, kA, last), Status::kOk);
  EXPECT_DOUBLE_EQ(readings().heading->value.value, 2.4152);
  EXPECT_EQ(readings().heading->time, last);
  EXPECT_EQ(heading(2.3152, kMagnetic, kA, last + Duration{1}), Status::kUnsupported);
}

TEST_F(SensorsTest, CorrectACompassByWhatItsOwnMessageSays) {
  ASSERT_EQ(accept(frame_of(kVariationPgn, {{"Variation", 1.0}})), Status::kOk);
  ASSERT_EQ(accept(frame_of(kHeadingPgn, {{"Heading", 3.0}, {"Deviation", -0.02}, {"Variation", 0.3}, {"Reference", kMagnetic}})),
            Status::kOk);
  EXPECT_NEAR(readings().heading->value.value, 3.28 - 2 * 3.141592653589793, 1e-12);  // in (-pi, pi]
  ASSERT_EQ(accept(frame_of(kHeadingPgn, {{"Heading", 3.0}, {"Deviation", -0.02}, {"Variation", 0.3}, {"Reference", kTrue}})), Status::kOk);
  EXPECT_EQ(readings().heading->value.value, 3.0) << "a true heading is corrected already";
}

TEST_F(SensorsTest, KeepToTheFirstOfTwoDevicesUntilItIsSilent) {
  ASSERT_EQ(heading(1.0, kTrue, kA), Status::kOk);
  EXPECT_EQ(heading(2.0, kTrue, kB, kNow + Duration{2'500'000}), Status::kNotReady);  // two and a half periods of a second
  EXPECT_EQ(readings().heading->value.value, 1.0);
  EXPECT_EQ(sensors_.counters().other_device, 1U);
  ASSERT_EQ(heading(2.0, kTrue, kB, kNow + Duration{2'500'001}), Status::kOk);
  EXPECT_EQ(heading(1.0, kTrue, kA, kNow + Duration{2'500'002}), Status::kNotReady);
  EXPECT_EQ(readings().heading->value.value, 2.0);
}

TEST_F(SensorsTest, LetNoDeviceWithoutAValueStandInTheWayOfOneThatHasOne) {
  EXPECT_EQ(accept(frame_of(kPositionPgn, {}, kA)), Status::kNotReady);
  EXPECT_EQ(accept(frame_of(kPositionPgn, {{"Latitude", 46.0}, {"Longitude", -1.3}}, kB)), Status::kOk);
  EXPECT_EQ(heading(1.0, kMagnetic, kA), Status::kUnsupported) << "without a variation";
  EXPECT_EQ(heading(2.0, kTrue, kB), Status::kOk);
  EXPECT_EQ(heading(1.0, kMagnetic, kA), Status::kNotReady) << "another's by now";
  EXPECT_EQ(accept(frame_of(kPressurePgn, {{"Source", 1}}, kA)), Status::kNotReady);
  EXPECT_EQ(accept(frame_of(kPressurePgn, {{"Source", 1}, {"Pressure", 1e5}}, kB)), Status::kOk);
  EXPECT_EQ(sensors_.counters().unavailable, 2U);
  EXPECT_EQ(sensors_.counters().no_variation, 1U);
}

TEST_F(SensorsTest, TakeAPositionOfADeviceWhoseOtherGroupSaysThatItHasNone) {
  MessageWriter writer(kGnssPgn);
  writer.set("Latitude", 46.0).set("Longitude", -1.3).set("Method", 0);
  FastPacketFrames packet;
  ASSERT_EQ(compose_fast_packet(writer.identifier(kA), 0, writer.bytes(), packet), Status::kOk);
  for (const Frame& frame : packet) EXPECT_EQ(accept(frame), Status::kNotReady);
  EXPECT_EQ(accept(frame_of(kPositionPgn, {{"Latitude", 46.5}, {"Longitude", -1.3}}, kA)), Status::kOk);
  EXPECT_EQ(readings().position->value.latitude_deg, 46.5);
}

TEST_F(SensorsTest, LeaveADeviceThatGivesNoMoreValuesThoughItGoesOnSending) {
  ASSERT_EQ(heading(1.0, kTrue, kA), Status::kOk);
  const Time later = kNow + Duration::seconds(2);
  EXPECT_EQ(accept(frame_of(kHeadingPgn, {{"Reference", kTrue}}, kA), later), Status::kNotReady);
  EXPECT_FALSE(readings().heading.has_value());
  EXPECT_EQ(heading(2.0, kTrue, kB, later), Status::kNotReady) << "it may have one again";
  EXPECT_EQ(heading(2.0, kTrue, kB, later + Duration::seconds(1)), Status::kOk);
  EXPECT_EQ(accept(frame_of(kHeadingPgn, {{"Reference", kTrue}}, kA), later + Duration::seconds(1)), Status::kNotReady);
  EXPECT_EQ(readings().heading->value.value, 2.0) << "which is not the first device's to take back";
}

TEST_F(SensorsTest, FollowADeviceToItsNewAddressAndNotItsAddressToAnotherDevice) {
  ASSERT_EQ(accept(claim_of(kNameOfA, kA)), Status::kNotReady);
  ASSERT_EQ(heading(1.0, kTrue, kA), Status::kOk);
  ASSERT_EQ(accept(claim_of(kNameOfB, kA)), Status::kNotReady);
  ASSERT_EQ(accept(claim_of(kNameOfA, kB)), Status::kNotReady);
  EXPECT_EQ(heading(2.0, kTrue, kA), Status::kNotReady);
  EXPECT_EQ(heading(1.5, kTrue, kB), Status::kOk);
  EXPECT_EQ(readings().heading->value.value, 1.5);
}

TEST_F(SensorsTest, TakeAQuantityFromTheDeviceThatTheMissionNames) {
  choose(Measured::kHeading, {.name = kNameOfB, .instance = {}});
  EXPECT_EQ(heading(1.0, kTrue, kA), Status::kNotReady);
  EXPECT_EQ(heading(2.0, kTrue, kB), Status::kNotReady) << "who this is nobody has said yet";
  ASSERT_EQ(accept(claim_of(kNameOfB, kB)), Status::kNotReady);
  EXPECT_EQ(heading(2.0, kTrue, kB), Status::kOk);
  EXPECT_EQ(heading(1.0, kTrue, kA, kNow + Duration::seconds(60)), Status::kNotReady) << "however long the other is silent";
  ASSERT_EQ(accept(claim_of(kNameOfB, 254)), Status::kNotReady);
  EXPECT_EQ(heading(2.0, kTrue, kB), Status::kNotReady) << "it has lost its address";
  EXPECT_EQ(sensors_.counters().not_chosen[static_cast<std::size_t>(Measured::kHeading)], 4U);
  EXPECT_EQ(sensors_.counters().not_chosen[static_cast<std::size_t>(Measured::kPosition)], 0U);
}

TEST_F(SensorsTest, TellSensorsOfOneDeviceApartByTheirInstance) {
  choose(Measured::kPressure, {.name = {}, .instance = 1});
  EXPECT_EQ(accept(frame_of(kPressurePgn, {{"Instance", 0}, {"Source", 1}, {"Pressure", 1e5}})), Status::kNotReady);
  EXPECT_EQ(accept(frame_of(kPressurePgn, {{"Source", 1}, {"Pressure", 1e5}})), Status::kNotReady) << "without an instance";
  EXPECT_EQ(accept(frame_of(kPressurePgn, {{"Instance", 1}, {"Source", 1}, {"Pressure", 2e5}})), Status::kOk);
  EXPECT_EQ(readings().pressure_pa->value, 2e5);
}

TEST_F(SensorsTest, TakeAGaugesPressureForDepth) {
  // 1025 kg/m3 * 9.80665 m/s2 * 10 m = 100518.1625 Pa, to 0.1 Pa.
  ASSERT_EQ(accept(frame_of(kPressurePgn, {{"Source", 1}, {"Pressure", 100'518.2}})), Status::kOk);
  EXPECT_NEAR(readings().depth->value.value, 10.0, 1e-5);
  ASSERT_EQ(accept(frame_of(kPressurePgn, {{"Source", 1}, {"Pressure", 5'000.0}})), Status::kOk);
  ASSERT_EQ(sensors_.zero_at_surface(), Status::kOk);
  EXPECT_EQ(readings().depth->value.value, 0.0);
  ASSERT_EQ(accept(frame_of(kPressurePgn, {{"Source", 1}, {"Pressure", 105'518.2}})), Status::kOk);
  EXPECT_NEAR(readings().depth->value.value, 10.0, 1e-5);
  EXPECT_EQ(sensors_.zero_at_surface(), Status::kOutOfRange) << "nobody is at the surface with that";
}

TEST_F(SensorsTest, MakeNoDepthOfAnAbsolutePressureBeforeTheSurfacesIsKnown) {
  sensors_ = Sensors({.sources = {}, .pressure_kind = PressureKind::kAbsolute, .surface_pa = {}});
  EXPECT_EQ(sensors_.zero_at_surface(), Status::kNotReady);
  EXPECT_EQ(accept(frame_of(kPressurePgn, {{"Source", 1}, {"Pressure", 101'325.0}})), Status::kUnsupported);
  EXPECT_FALSE(readings().depth.has_value());
  EXPECT_EQ(sensors_.counters().no_surface, 1U);
  ASSERT_EQ(sensors_.zero_at_surface(), Status::kOk);
  ASSERT_EQ(accept(frame_of(kPressurePgn, {{"Source", 1}, {"Pressure", 201'843.2}})), Status::kOk);
  EXPECT_NEAR(readings().depth->value.value, 10.0, 1e-5);
}

TEST_F(SensorsTest, TakeBackWhatADeviceNoLongerHas) {
  ASSERT_EQ(accept(frame_of(kWaterDepthPgn, {{"Depth", 2.05}, {"Offset", -0.001}})), Status::kOk);
  EXPECT_EQ(readings().altitude->value.value, 2.05);
  EXPECT_EQ(accept(frame_of(kWaterDepthPgn, {{"Offset", -0.001}})), Status::kNotReady);
  EXPECT_FALSE(readings().altitude.has_value());
  EXPECT_EQ(sensors_.counters().unavailable, 1U);
}

TEST_F(SensorsTest, RefuseReservedAndOutOfRangeWithoutForgetting) {
  ASSERT_EQ(accept(frame_of(kSpeedPgn, {{"SpeedWaterReferenced", 1.5}})), Status::kOk);
  Frame frame = frame_of(kSpeedPgn, {});
  for (const std::uint8_t low : {std::uint8_t{0xFE}, std::uint8_t{0xFD}}) {
    frame.data[1] = low;
    EXPECT_EQ(accept(frame), Status::kOutOfRange);
  }
  EXPECT_EQ(readings().speed->value.value, 1.5);
  EXPECT_EQ(sensors_.counters().refused, 2U);
}

TEST_F(SensorsTest, TakeNoPositionThatIsNotMeasured) {
  std::uint8_t sequence = 0;
  for (const int method : {0, 7, 8}) {  // no GNSS, manual input, simulate mode
    MessageWriter writer(kGnssPgn);
    writer.set("Latitude", 46.0).set("Longitude", -1.3).set("Method", method);
    FastPacketFrames packet;
    ASSERT_EQ(compose_fast_packet(writer.identifier(kA), sequence++, writer.bytes(), packet), Status::kOk);
    for (const Frame& frame : packet) EXPECT_EQ(accept(frame), Status::kNotReady) << method;
  }
  EXPECT_FALSE(readings().position.has_value());
  EXPECT_EQ(sensors_.counters().unavailable, 3U);
}

TEST_F(SensorsTest, TakeAPositionHoweverManyReferenceStationsFollow) {
  MessageWriter writer(kGnssPgn);
  writer.set("Latitude", 46.0).set("Longitude", -1.3).set("Method", 2).set("ReferenceStations", 2);
  std::vector<std::uint8_t> bytes(writer.bytes().begin(), writer.bytes().end());
  bytes.insert(bytes.end(), {0x12, 0x34, 0x10, 0x27, 0xFF, 0xFF, 0xFF, 0xFF});
  FastPacketFrames packet;
  ASSERT_EQ(compose_fast_packet(writer.identifier(kA), 0, bytes, packet), Status::kOk);
  Status status = Status::kNotReady;
  for (const Frame& frame : packet) status = accept(frame);
  EXPECT_EQ(status, Status::kOk);
  EXPECT_EQ(readings().position->value.latitude_deg, 46.0);
}

TEST_F(SensorsTest, DoNotMixTwoKindsOfPositionOfOneDevice) {
  ASSERT_EQ(accept(frame_of(kPositionPgn, {{"Latitude", 46.0}, {"Longitude", -1.0}})), Status::kOk);
  MessageWriter writer(kGnssPgn);
  writer.set("Latitude", 47.0).set("Longitude", -1.3).set("Method", 1);
  FastPacketFrames packet;
  ASSERT_EQ(compose_fast_packet(writer.identifier(kA), 0, writer.bytes(), packet), Status::kOk);
  for (const Frame& frame : packet) EXPECT_EQ(accept(frame), Status::kNotReady);
  EXPECT_EQ(readings().position->value.latitude_deg, 46.0);
}

TEST_F(SensorsTest, ReadTheRestOfWhatTheyKnow) {
  ASSERT_EQ(accept({.identifier = 0x09F113CC, .size = 8, .data = {0xFF, 0xC3, 0x6F, 0, 0, 0xFF, 0xFF, 0xFF}}), Status::kOk);
  EXPECT_EQ(readings().rate_of_turn->value.value, 0.00089409375);
  ASSERT_EQ(accept({.identifier = 0x0DF119CC, .size = 8, .data = {0xFF, 0x70, 0x5A, 0xF7, 0xF7, 0xFD, 0x04, 0xFF}}), Status::kOk);
  EXPECT_EQ(readings().attitude->value.pitch.value, -0.2057);
  EXPECT_EQ(readings().attitude->value.roll.value, 0.1277);
  ASSERT_EQ(accept({.identifier = 0x09F10DCC, .size = 8, .data = {0, 0xFF, 0xFF, 0x7F, 0xE9, 0xFB, 0xFF, 0xFF}}), Status::kOk);
  EXPECT_EQ(readings().rudder->value.value, -0.1047);
  ASSERT_EQ(accept({.identifier = 0x09F8022B, .size = 8, .data = {0xFF, 0, 0, 0, 1, 0, 0, 0}}), Status::kOk);
  EXPECT_EQ(readings().over_ground->value.speed.value, 0.01);
  ASSERT_EQ(accept(frame_of(kBatteryPgn, {{"Instance", 0}, {"Voltage", 24.5}})), Status::kOk);
  EXPECT_EQ(readings().battery->value.voltage_v, 24.5);
  EXPECT_FALSE(readings().battery->value.current_a.has_value());
  EXPECT_EQ(accept(frame_of(kTemperaturePgn, {{"Instance", 0}, {"Source", 2}, {"ActualTemperature", 300}})), Status::kNotReady) << "inside";
  ASSERT_EQ(accept(frame_of(kTemperaturePgn, {{"Instance", 0}, {"Source", 0}, {"ActualTemperature", 280.15}})), Status::kOk);
  EXPECT_EQ(readings().water_temperature_k->value, 280.15);
}

/// A fast packet (127506) of 11 bytes from device A.
struct ChargeFrames {
  ChargeFrames(std::uint8_t instance, std::uint8_t type, std::uint8_t percent)
      : first{.identifier = 0x19F2120A, .size = 8, .data = {0x00, 11, 0xFF, instance, type, percent, 0xFF, 0xFF}},
        second{.identifier = 0x19F2120A, .size = 8, .data = {0x01, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF}} {}
  Frame first;
  Frame second;
};

TEST_F(SensorsTest, ReadTheChargeOfOneBatteryOutOfAFastPacket) {
  choose(Measured::kCharge, {.name = {}, .instance = 1});
  const ChargeFrames ours(1, 0, 73);
  EXPECT_EQ(accept(ours.first), Status::kNotReady);
  ASSERT_EQ(accept(ours.second, kNow + Duration{1000}), Status::kOk);
  EXPECT_EQ(measured_, Measured::kCharge);
  EXPECT_EQ(readings().charge_percent->value, 73.0);
  EXPECT_EQ(readings().charge_percent->time, kNow) << "of its first frame";
  const ChargeFrames others(2, 0, 20);
  EXPECT_EQ(accept(others.first), Status::kNotReady);
  EXPECT_EQ(accept(others.second), Status::kNotReady);
  EXPECT_EQ(sensors_.counters().other_device, 1U);
  const ChargeFrames solar(1, 3, 20);
  EXPECT_EQ(accept(solar.first), Status::kNotReady);
  EXPECT_EQ(accept(solar.second), Status::kNotReady);
  EXPECT_EQ(sensors_.counters().of_no_interest, 1U);
  EXPECT_EQ(readings().charge_percent->value, 73.0);
}

TEST_F(SensorsTest, KnowWhenTheDeviceThatAQuantityIsTakenFromSpokeLast) {
  const auto altitude = [this](std::initializer_list<Value> values, std::uint8_t source, Time now) {
    (void)accept(frame_of(kWaterDepthPgn, values, source), now);
    return sensors_.heard(Measured::kAltitude);
  };
  EXPECT_FALSE(sensors_.heard(Measured::kAltitude));
  EXPECT_EQ(altitude({}, kA, kNow), kNow) << "that it has no value is said, too";
  EXPECT_EQ(altitude({{"Depth", 5}}, kA, kNow + Duration{1}), kNow + Duration{1});
  EXPECT_EQ(altitude({}, kA, kNow + Duration{2}), kNow + Duration{2});
  EXPECT_EQ(altitude({{"Depth", 5}}, kB, kNow + Duration{3}), kNow + Duration{2}) << "another's";
  EXPECT_FALSE(sensors_.heard(Measured::kCharge));
}

TEST_F(SensorsTest, CountNothingBeforeAnythingCame) {
  const SensorCounters& counters = sensors_.counters();
  EXPECT_EQ(counters.taken + counters.refused + counters.unavailable + counters.other_device, 0U);
  EXPECT_EQ(counters.no_variation + counters.no_surface + counters.of_no_interest, 0U);
  for (const std::uint64_t not_chosen : counters.not_chosen) EXPECT_EQ(not_chosen, 0U);
}

TEST_F(SensorsTest, SayWhatTheyMeasuredAndCountIt) {
  ASSERT_EQ(heading(1.0, kTrue), Status::kOk);
  EXPECT_EQ(measured_, Measured::kHeading);
  ASSERT_EQ(accept(frame_of(kPressurePgn, {{"Source", 1}, {"Pressure", 1e5}})), Status::kOk);
  EXPECT_EQ(measured_, Measured::kPressure);
  ASSERT_EQ(accept(frame_of(kTemperaturePgn, {{"Source", 0}, {"ActualTemperature", 280.15}})), Status::kOk);
  EXPECT_EQ(measured_, Measured::kTemperature);
  EXPECT_EQ(sensors_.counters().taken, 3U);
}

TEST_F(SensorsTest, CountWhatIsMeasuredInAirOrInNoGroupOfTheirsAsOfNoInterest) {
  EXPECT_EQ(accept(frame_of(kPressurePgn, {{"Source", 0}, {"Pressure", 101'325.0}})), Status::kNotReady);
  EXPECT_EQ(sensors_.counters().of_no_interest, 1U);
  EXPECT_EQ(accept(frame_of(kTemperaturePgn, {{"Source", 1}, {"ActualTemperature", 300}})), Status::kNotReady);
  EXPECT_EQ(sensors_.counters().of_no_interest, 2U);
  EXPECT_EQ(accept({.identifier = 0x09F200CC}), Status::kNotReady) << "127488, an engine";
  EXPECT_EQ(sensors_.counters().of_no_interest, 3U);
  EXPECT_EQ(accept({.identifier = 0x20000000}), Status::kNotReady) << "more than 29 bits";
  EXPECT_EQ(sensors_.counters().of_no_interest, 4U);
  EXPECT_EQ(sensors_.counters().taken, 0U);
  EXPECT_FALSE(readings().pressure_pa || readings().depth || readings().water_temperature_k);
}

TEST_F(SensorsTest, KeepTheirDepthWhileAnotherDeviceOrTheAirTellsAPressure) {
  ASSERT_EQ(accept(frame_of(kPressurePgn, {{"Source", 1}, {"Pressure", 100'518.2}}, kA)), Status::kOk);
  EXPECT_EQ(accept(frame_of(kPressurePgn, {{"Source", 1}, {"Pressure", 5e6}}, kB)), Status::kNotReady);
  EXPECT_EQ(accept(frame_of(kPressurePgn, {{"Source", 0}, {"Pressure", 101'325.0}}, kA)), Status::kNotReady);
  EXPECT_EQ(accept(frame_of(kPressurePgn, {{"Source", 0xFC}, {"Pressure", 5e6}}, kA)), Status::kNotReady);
  ASSERT_TRUE(readings().depth.has_value());
  EXPECT_NEAR(readings().depth->value.value, 10.0, 1e-5);
  EXPECT_EQ(accept(frame_of(kPressurePgn, {{"Source", 1}}, kA)), Status::kNotReady);
  EXPECT_FALSE(readings().depth.has_value()) << "which its sensor takes back with the pressure";
}

TEST_F(SensorsTest, AreAtTheSurfaceBetween80And110KilopascalsOrWithin20OfAGaugesZero) {
  struct Row {
    PressureKind kind;
    double pressure_pa;
    Status expected;
  };
  using enum PressureKind;
  using enum Status;
  for (const Row& row : {Row{kGauge, -20'000.1, kOutOfRange}, Row{kGauge, -20'000, kOk}, Row{kGauge, 20'000, kOk},
                         Row{kGauge, 20'000.1, kOutOfRange}, Row{kAbsolute, 79'999.9, kOutOfRange}, Row{kAbsolute, 80'000, kOk},
                         Row{kAbsolute, 110'000, kOk}, Row{kAbsolute, 110'000.1, kOutOfRange}}) {
    sensors_ = Sensors({.sources = {}, .pressure_kind = row.kind, .surface_pa = {}});
    static_cast<void>(accept(frame_of(kPressurePgn, {{"Source", 1}, {"Pressure", row.pressure_pa}})));
    EXPECT_EQ(sensors_.zero_at_surface(), row.expected) << row.pressure_pa;
    EXPECT_EQ(readings().depth.has_value() && readings().depth->value.value == 0.0, row.expected == kOk) << row.pressure_pa;
  }
}

TEST_F(SensorsTest, RefuseAFrameCutShortWithoutForgettingWhatItSaidBefore) {
  ASSERT_EQ(heading(1.0, kTrue), Status::kOk);
  Frame frame = frame_of(kHeadingPgn, {{"Heading", 2.0}, {"Reference", kTrue}});
  for (const std::uint8_t size : {std::uint8_t{2}, std::uint8_t{7}}) {
    frame.size = size;
    EXPECT_EQ(accept(frame), Status::kMalformed) << "without its heading, without its reference";
  }
  EXPECT_EQ(accept(frame_of(kHeadingPgn, {{"Heading", 2.0}})), Status::kUnsupported) << "a reference that is not available";
  EXPECT_EQ(readings().heading->value.value, 1.0);
  for (const std::uint32_t pgn : {kPressurePgn, kTemperaturePgn}) {
    Frame cut = frame_of(pgn, {{"Source", 1}});
    cut.size = 2;
    EXPECT_EQ(accept(cut), Status::kMalformed);
  }
  EXPECT_EQ(sensors_.counters().refused, 5U);
}

TEST_F(SensorsTest, TakeAMagneticCourseForNone) {
  EXPECT_EQ(accept(frame_of(kCoursePgn, {{"COGReference", kMagnetic}, {"COG", 1}, {"SOG", 2}})), Status::kUnsupported);
  EXPECT_EQ(accept(frame_of(kCoursePgn, {{"COG", 1}, {"SOG", 2}})), Status::kUnsupported) << "of an unknown reference";
}

}  // namespace
}  // namespace earshot::n2k
