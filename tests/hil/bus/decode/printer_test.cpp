#include "hil/bus/decode/printer.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <ctime>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

#include "firmware/wire/n2k/own/reports.hpp"
#include "tests/support/text/tells.hpp"

namespace earshot::hil {
namespace {

constexpr n2k::Frame kHeading{.identifier = 0x09F1127F, .size = 8, .data = {0xFF, 0x70, 0x5A, 0xFF, 0x7F, 0xFF, 0x7F, 0xFD}};
constexpr n2k::Frame kUnknown{.identifier = 0x09F1997F, .size = 2, .data = {0xAB, 0x01}};
constexpr Time kTime{1'436'509'052'249'713};

Heard heard_of(const n2k::Frame& frame, std::optional<Time> time = kTime) {
  Decoder decoder;
  Heard heard;
  EXPECT_EQ(decoder.accept({.time = time, .interface = "can0", .frame = frame}, heard), Decoder::Taken::kMessage);
  return heard;
}

std::string printed(Format format, const Heard& heard, Times times = Times::kAsLogged) {
  std::ostringstream out;
  printer_of(format, times)->print(out, heard);
  return out.str();
}

TEST(Printer, SaysAMessageInALine) {
  Heard heard = heard_of(kHeading);
  EXPECT_TRUE(support::lines_tell(printed(Format::kText, heard),
                                  {{"1436509052.249713", "can0", "127", "127250", "VesselHeading", "SID", "not", "Heading", "2.3152 rad",
                                    "132.65 deg", "Deviation", "not", "Variation", "not", "Reference"}}));
  heard.source_name =
      "com\x1b"
      "pass";
  EXPECT_TRUE(printed(Format::kText, heard).starts_with("1436509052.249713 can0 127 (com\\x1bpass): 127250 "));
}

TEST(Printer, SaysWhatItDoesNotKnowInHexadecimal) {
  EXPECT_EQ(printed(Format::kText, heard_of(kUnknown, std::nullopt)), "- can0 127: 127385 unknown AB01\n");
  EXPECT_EQ(
      printed(Format::kJson, heard_of(kUnknown, std::nullopt)),
      R"({"time":null,"interface":"can0","source":127,"name":null,"destination":255,"priority":2,"pgn":127385,"message":null,"data":"AB01"})"
      "\n");
  EXPECT_EQ(printed(Format::kCsv, heard_of(kUnknown)),
            "time,interface,source,destination,priority,pgn,message,signal,value,unit\n"
            "1436509052.249713,can0,127,255,2,127385,,data,AB01,\n");
}

TEST(Printer, WritesAnObjectALine) {
  const auto json = nlohmann::json::parse(printed(Format::kJson, heard_of(kHeading)));
  EXPECT_EQ(json.at("time").get<double>(), 1436509052.249713);
  EXPECT_EQ(json.at("message"), "VesselHeading");
  EXPECT_EQ(json.at("signals").at("Heading"), nlohmann::json::parse(R"({"value": 2.3152, "unit": "rad"})"));
  EXPECT_EQ(json.at("signals").at("Reference"), nlohmann::json::parse(R"({"value": "Magnetic"})"));
  EXPECT_EQ(json.at("signals").at("SID"), nlohmann::json::parse(R"({"value": null, "why": "not available"})"));
}

// 128259, byte 5: type 9 of a list that ends at 4.
TEST(Printer, WritesTheNumberOfWhatHasNoWord) {
  const Heard heard = heard_of({.identifier = 0x09F5037F, .size = 8, .data = {0, 0, 0, 0, 0, 9, 0xFF, 0xFF}});
  EXPECT_EQ(nlohmann::json::parse(printed(Format::kJson, heard)).at("signals").at("SpeedWaterReferencedType"),
            nlohmann::json::parse(R"({"value": 9.0})"));
  EXPECT_NE(printed(Format::kCsv, heard).find(",SpeedWaterReferencedType,9,\n"), std::string::npos);
}

TEST(Printer, SaysOfAFlightWhoseVehicleDeclaredItsSourceFoundThatItEndedSo) {
  messages::Health health;
  health.state = messages::MissionState::kDone;
  health.end_reason = messages::EndReason::kFound;
  health.is_found = health.is_sweeping = true;
  health.response = config::Response::kSteerBack;
  health.mismatch_bits = 7.25F;
  n2k::FastPacketFrames frames;
  ASSERT_EQ(n2k::compose_health(health, Time{5}, {.source = 0x40}, frames), Status::kOk);
  Decoder decoder;
  Heard heard;
  Decoder::Taken taken{};
  for (const n2k::Frame& frame : frames) taken = decoder.accept({.time = kTime, .interface = "can0", .frame = frame}, heard);
  ASSERT_EQ(taken, Decoder::Taken::kMessage);
  const std::string line = printed(Format::kText, heard);
  for (const char* said :
       {"State = DONE", "EndReason = declared found", "Found = Yes", "Sweeping = Yes", "Response = steer back", "ModelMismatch = 7.25 bit"})
    EXPECT_NE(line.find(said), std::string::npos) << said << " in " << line;
}

TEST(Printer, WritesAnObjectOfTextThatIsNoUtf8) {
  Heard heard = heard_of(kHeading);
  heard.source_name = "\xff\x1b";
  heard.values.at(0) = {.name = "Model", .kind = Value::Kind::kText, .text = "\xc3"};
  const auto json = nlohmann::json::parse(printed(Format::kJson, heard));
  EXPECT_EQ(json.at("name"), "\\xff\\x1b");
  EXPECT_EQ(json.at("signals").at("Model").at("value"), "\\xc3");
}

TEST(Printer, WritesARowASignalUnderOneHead) {
  std::ostringstream out;
  const auto printer = printer_of(Format::kCsv, Times::kAsLogged);
  Heard heard = heard_of(kHeading);
  heard.values.erase(heard.values.begin() + 2, heard.values.end());
  printer->print(out, heard);
  heard.values.at(0) = {.name = "Model", .kind = Value::Kind::kText, .text = "a,\"b\""};
  printer->print(out, heard);
  EXPECT_EQ(out.str(),
            "time,interface,source,destination,priority,pgn,message,signal,value,unit\n"
            "1436509052.249713,can0,127,255,2,127250,VesselHeading,SID,not available,\n"
            "1436509052.249713,can0,127,255,2,127250,VesselHeading,Heading,2.3152,rad\n"
            "1436509052.249713,can0,127,255,2,127250,VesselHeading,Model,\"a,\"\"b\"\"\",\n"
            "1436509052.249713,can0,127,255,2,127250,VesselHeading,Heading,2.3152,rad\n");
}

// date -u -d @1436509052 gives 2015-07-10 06:17:32.
TEST(TimeWriter, WritesWhatIsAskedFor) {
  ::setenv("TZ", "CEST-2", 1);
  ::tzset();
  EXPECT_EQ(TimeWriter(Times::kUtc).write(kTime), "2015-07-10T06:17:32.249713Z");
  EXPECT_EQ(TimeWriter(Times::kLocal).write(kTime), "2015-07-10 08:17:32.249713");
  EXPECT_EQ(TimeWriter(Times::kAsLogged).write(kTime), "1436509052.249713");
  EXPECT_EQ(TimeWriter(Times::kUtc).write(std::nullopt), "");
  TimeWriter relative(Times::kRelative);
  EXPECT_EQ(relative.write(kTime), "0.000000");
  EXPECT_EQ(relative.write(Time{kTime.us + 1'000'001}), "1.000001");
  EXPECT_EQ(relative.write(Time{kTime.us - 1}), "-0.000001");
}

}  // namespace
}  // namespace earshot::hil
