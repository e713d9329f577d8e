#include "hil/bus/decode/value.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "hil/bus/decode/decoder.hpp"
#include "tests/firmware/wire/n2k/recorded_bus.hpp"

namespace earshot::hil {
namespace {

using Bytes = std::vector<std::uint8_t>;

std::string said(std::uint32_t pgn, const Bytes& bytes, const std::string& name) {
  for (const Value& value : values_of(*n2k::find_message(pgn), bytes)) {
    if (value.name == name) return to_string(value);
  }
  return "no such field";
}

// Bytes by hand: heading 0x5A70 = 23152 steps of 1e-4 rad, which are 132.65 degrees; its reference is 1.
TEST(Value, SaysNumbersWithTheirUnitAndChoicesByWord) {
  const Bytes bytes{0xFF, 0x70, 0x5A, 0xFF, 0x7F, 0xFF, 0x7F, 0xFD};
  EXPECT_EQ(said(127250, bytes, "Heading"), "2.3152 rad (132.65 deg)");
  EXPECT_EQ(said(127250, bytes, "Reference"), "Magnetic");
  EXPECT_EQ(said(127250, bytes, "Deviation"), "not available");
}

TEST(Value, SaysWhyItIsNone) {
  // Speeds 0xFFFE and 0xFFFD; type 9 has no word, and stands as it is; the message ends before its direction.
  const Bytes speed{0x00, 0xFE, 0xFF, 0xFD, 0xFF, 0x09};
  EXPECT_EQ(said(128259, speed, "SpeedWaterReferenced"), "out of range");
  EXPECT_EQ(said(128259, speed, "SpeedGroundReferenced"), "reserved");
  EXPECT_EQ(said(128259, speed, "SpeedWaterReferencedType"), "9");
  EXPECT_EQ(said(128259, speed, "SpeedDirection"), "missing");
  // 0x3B9ACA00 = 1e9 steps of 1e-7 degree.
  EXPECT_EQ(said(129025, {0x00, 0xCA, 0x9A, 0x3B, 0xFF, 0xFF, 0xFF, 0x7F}, "Latitude"), "not allowed: 100 deg");
}

TEST(Value, PrintsTextFromTheBusSafely) {
  Bytes product(134, 0xFF);
  const std::string model = "a\x1b[2J";
  std::ranges::copy(model, product.begin() + 4);
  EXPECT_EQ(said(126996, product, "ModelID"), "\"a\\x1b[2J\"");
  EXPECT_EQ(said(126996, product, "ModelVersion"), "not available");
  EXPECT_EQ(said(126996, Bytes(20, 'x'), "ModelVersion"), "missing");
}

// Sizes count themselves and the encoding: 4 bytes of "ab"; 2 of nothing; then a size of 9 of which 1 is there; or two bytes a character.
TEST(Value, ReadsTextsThatFollowEachOther) {
  const Bytes cut{4, 1, 'a', 'b', 2, 1, 9};
  EXPECT_EQ(said(126998, cut, "InstallationDescription1"), "\"ab\"");
  EXPECT_EQ(said(126998, cut, "InstallationDescription2"), "not available");
  EXPECT_EQ(said(126998, cut, "ManufacturerInformation"), "unreadable");
  // Behind a size that is wrong nobody knows where the next text begins.
  const Bytes lost{9, 1, 'a', 'b'};
  EXPECT_EQ(said(126998, lost, "InstallationDescription1"), "unreadable");
  EXPECT_EQ(said(126998, lost, "InstallationDescription2"), "missing");
  const Bytes wide{6, 0, 'a', 0, 0xF3, 0, 3, 1, 'c'};
  EXPECT_EQ(said(126998, wide, "InstallationDescription1"), "\"a\u00F3\"");
  EXPECT_EQ(said(126998, wide, "InstallationDescription2"), "\"c\"");
  EXPECT_EQ(said(126998, wide, "ManufacturerInformation"), "missing");
}

// 129025 = 0x01F801, 129029 = 0x01F805.
TEST(Value, ReadsWhatAMessageRepeats) {
  const Bytes list{0x00, 0x01, 0xF8, 0x01, 0x05, 0xF8, 0x01};
  EXPECT_EQ(said(126464, list, "PGN"), "129025");
  EXPECT_EQ(said(126464, list, "PGN[1]"), "129029");
  EXPECT_EQ(said(126464, list, "PGN[2]"), "no such field");
  EXPECT_EQ(said(126464, list, "FunctionCode[1]"), "no such field");
}

/// Of a message that the decoder makes of one frame.
std::string heard(std::uint32_t pgn, const Bytes& bytes, const std::string& name) {
  n2k::Frame frame{.identifier = n2k::compose({pgn, 6, 1, n2k::kBroadcast}).value(), .size = 8};
  std::ranges::copy(bytes, frame.data.begin());
  Decoder decoder;
  Heard message;
  EXPECT_EQ(decoder.accept({.time = Time{}, .interface = "can0", .frame = frame}, message), Decoder::Taken::kMessage);
  for (const Value& value : message.values) {
    if (value.name == name) return to_string(value);
  }
  return "no such field";
}

// Samples of canboat's database, and what it reads there.
TEST(Value, ReadsMessagesThatOnlyADeskHasAUseFor) {
  const Bytes time{0x36, 0xF0, 0x2D, 0x4B, 0x10, 0x6D, 0xFF, 0x19};
  EXPECT_EQ(heard(126992, time, "Source"), "GPS");
  EXPECT_EQ(heard(126992, time, "Date"), "19245 d");
  EXPECT_EQ(heard(126992, time, "Time"), "43617 s");
  EXPECT_EQ(heard(127252, {0x00, 0x45, 0x10, 0xFF, 0xFF, 0xFF, 0x7F, 0xFD}, "Heave"), "41.65 m");
  const Bytes dops{0x45, 0xD7, 0x62, 0x02, 0x36, 0x01, 0xFF, 0x7F};
  EXPECT_EQ(heard(129539, dops, "DesiredMode"), "not available");
  EXPECT_EQ(heard(129539, dops, "ActualMode"), "3D");
  EXPECT_EQ(heard(129539, dops, "HDOP"), "6.1");
  EXPECT_EQ(heard(129539, dops, "VDOP"), "3.1");
  EXPECT_EQ(heard(129539, dops, "TDOP"), "not available");
  const Bytes air{0x70, 0xC1, 0x43, 0x71, 0xFF, 0x7F, 0xFE, 0x03};
  EXPECT_EQ(heard(130311, air, "TemperatureSource"), "Outside Temperature");
  EXPECT_EQ(heard(130311, air, "HumiditySource"), "not available");
  EXPECT_EQ(heard(130311, air, "Temperature"), "289.95 K");
  EXPECT_EQ(heard(130311, air, "Humidity"), "not available");
  EXPECT_EQ(heard(130311, air, "AtmosphericPressure"), "102200 Pa");
  // 0x30D4 = 12500 steps of 0.004 %.
  EXPECT_EQ(heard(130311, {0x70, 0x41, 0x43, 0x71, 0xD4, 0x30, 0xFE, 0x03}, "Humidity"), "50 %");
  EXPECT_EQ(heard(130311, {0x70, 0x41, 0x43, 0x71, 0xD4, 0x30, 0xFE, 0x03}, "HumiditySource"), "Outside");
}

// By hand: type 4 in the low bits and identifier 0x123 above, 0x00C8 = 200 steps of 10 ms; the second breaks off.
TEST(Value, ReadsAsManyReferenceStationsAsAPositionHas) {
  Bytes position(43, 0x00);
  position[42] = 2;
  const Bytes stations{0x34, 0x12, 0xC8, 0x00, 0x51, 0x00};
  position.insert(position.end(), stations.begin(), stations.end());
  EXPECT_EQ(said(129029, position, "ReferenceStationType"), "GPS+SBAS/WAAS+GLONASS");
  EXPECT_EQ(said(129029, position, "ReferenceStationID"), "291");
  EXPECT_EQ(said(129029, position, "AgeOfDGNSSCorrections"), "2 s");
  EXPECT_EQ(said(129029, position, "ReferenceStationType[1]"), "GLONASS");
  EXPECT_EQ(said(129029, position, "ReferenceStationID[1]"), "5");
  EXPECT_EQ(said(129029, position, "AgeOfDGNSSCorrections[1]"), "missing");
  EXPECT_EQ(said(129029, position, "ReferenceStationType[2]"), "no such field");
  for (const std::uint8_t none : Bytes{0x00, 0xFF}) {
    position[42] = none;
    EXPECT_EQ(said(129029, position, "ReferenceStationType"), "no such field");
  }
  position.resize(43);
  position[42] = 252;
  EXPECT_EQ(said(129029, position, "ReferenceStationType"), "missing");
  EXPECT_EQ(said(129029, position, "ReferenceStationType[1]"), "no such field");
}

// Every field of every message recorded on real buses, with fast packets put together, against canboat.
TEST(Value, IsWhatCanboatReads) {
  int compared = 0;
  for (const n2k::Recorded& recorded : n2k::recorded_bus()) {
    Decoder decoder;
    Heard heard;
    auto taken = Decoder::Taken::kNothingYet;
    for (const n2k::Frame& frame : recorded.frames) taken = decoder.accept({.time = Time{}, .interface = "can0", .frame = frame}, heard);
    ASSERT_EQ(taken, Decoder::Taken::kMessage) << recorded.pgn;
    EXPECT_EQ(heard.identifier.pgn, recorded.pgn);
    EXPECT_EQ(heard.identifier.source, recorded.source);
    for (const Value& value : heard.values) {
      const auto expected = recorded.fields.find(value.name);
      if (expected == recorded.fields.end()) continue;
      ++compared;
      EXPECT_EQ(value.kind == Value::Kind::kNotAvailable, !expected->second) << recorded.pgn << ' ' << value.name;
      // canboat's decimals are rounded to the field's own step.
      if (value.kind == Value::Kind::kNumber) {
        EXPECT_NEAR(value.number, *expected->second, 1e-6) << recorded.pgn << ' ' << value.name;
      }
    }
  }
  EXPECT_GT(compared, 100);
}

}  // namespace
}  // namespace earshot::hil
