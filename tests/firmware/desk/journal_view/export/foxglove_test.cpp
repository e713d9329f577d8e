#include "firmware/desk/journal_view/export/foxglove.hpp"

#include <gtest/gtest.h>

#include "firmware/desk/journal_view/export/fields.hpp"
#include "tests/firmware/host/journal/known_journal.hpp"

namespace earshot::journal {
namespace {

// Heading 30 degrees is 60 degrees from east: the quaternion (0, 0, sin 30, cos 30) = (0, 0, 1/2, sqrt(3)/2).
TEST(Foxglove, PosesAreEastNorthUpAndTurnTheBowFromEast) {
  const nlohmann::ordered_json pose = pose_in_frame(known_fix(Time{7'500'000})).at("pose");
  EXPECT_EQ(to_line(pose.at("position")), R"({"x":2000.0,"y":1000.0,"z":-299.5})");
  EXPECT_DOUBLE_EQ(pose.at("orientation").at("z").get<double>(), 0.5);
  EXPECT_DOUBLE_EQ(pose.at("orientation").at("w").get<double>(), 0.86602540378443864676);
}

TEST(Foxglove, TimesAreSecondsAndNanosecondsNeverNegative) {
  EXPECT_EQ(to_line(pose_in_frame(known_fix(Time{7'500'001})).at("timestamp")), R"({"sec":7,"nsec":500001000})");
  EXPECT_EQ(to_line(pose_in_frame(known_fix(Time{-1})).at("timestamp")), R"({"sec":0,"nsec":0})");
}

// One kilometre north on the WGS-84 ellipsoid at latitude 0 is 1000 m / 110574.27 m a degree.
TEST(Foxglove, FixesAreGeographicAndTheirAltitudeIsTheDepthNegative) {
  const n2k::LocalPlane plane = n2k::LocalPlane::about({.latitude_deg = 0.0, .longitude_deg = 10.0}).value();
  messages::Navigation fix = known_fix(kBegan);
  fix.position.east = Meters{0};
  const auto location = location_fix(fix, plane);
  ASSERT_TRUE(location);
  EXPECT_NEAR(location->at("latitude").get<double>(), 1000.0 / 110'574.27, 1e-8);  // the radius above has seven digits
  EXPECT_DOUBLE_EQ(location->at("longitude").get<double>(), 10.0);
  EXPECT_EQ(location->at("altitude"), -299.5);
}

TEST(Foxglove, LeavesOutAPlaceThatThePlaneDoesNotReach) {
  messages::Navigation fix = known_fix(kBegan);
  fix.position = at(1e7, 0);
  EXPECT_FALSE(location_fix(fix, {}));
}

TEST(Foxglove, LogsSayInformationWarningErrorAsTheSchemaCountsThem) {
  using Severity = Event::Severity;
  EXPECT_EQ(log_of({.severity = Severity::kInformation, .time = kBegan, .text = "a"}).at("level"), 2);
  EXPECT_EQ(log_of({.severity = Severity::kWarning, .time = kBegan, .text = "a"}).at("level"), 3);
  EXPECT_EQ(log_of({.severity = Severity::kError, .time = kBegan, .text = "a"}).at("level"), 4);
}

TEST(Foxglove, SchemasOfTheirMessagesAreJson) {
  for (const Schema& schema : {kPoseSchema, kLocationSchema, kLogSchema}) {
    const nlohmann::json json = nlohmann::json::parse(schema.json);
    EXPECT_EQ(json.at("title"), schema.name);
    EXPECT_EQ(json.at("type"), "object");
  }
  // Every field that is sent is in the schema.
  const auto expect_all = [](const nlohmann::ordered_json& message, const Schema& schema) {
    const nlohmann::json properties = nlohmann::json::parse(schema.json).at("properties");
    EXPECT_EQ(message.size(), properties.size());
    for (const auto& [name, value] : message.items()) EXPECT_TRUE(properties.contains(name)) << name;
  };
  expect_all(pose_in_frame(known_fix(kBegan)), kPoseSchema);
  expect_all(*location_fix(known_fix(kBegan), {}), kLocationSchema);
  expect_all(log_of({}), kLogSchema);
}

TEST(Foxglove, SchemasOfOtherObjectsSayWhatTheirFieldsAre) {
  const nlohmann::ordered_json example = nlohmann::ordered_json::parse(R"({"a":1,"b":0.5,"c":true,"d":"x","e":[0.5],"g":{"h":1.5}})");
  EXPECT_EQ(to_line(schema_of(example)),
            R"({"type":"object","properties":{"a":{"type":"integer"},"b":{"type":"number"},"c":{"type":"boolean"},"d":{"type":"string"},)"
            R"("e":{"type":"array","items":{"type":"number"}},"g":{"type":"object","properties":{"h":{"type":"number"}}}}})");
}

}  // namespace
}  // namespace earshot::journal
