#include "firmware/desk/journal_view/export/foxglove.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace earshot::journal {
namespace {

using Json = nlohmann::ordered_json;

/// foxglove's time: seconds and nanoseconds, neither negative.
Json timestamp_of(Time time) {
  constexpr std::int64_t kMicrosecondsPerSecond = 1'000'000;
  const std::int64_t us = std::max<std::int64_t>(time.us, 0);
  return {{"sec", us / kMicrosecondsPerSecond}, {"nsec", us % kMicrosecondsPerSecond * 1000}};
}

const char* type_of(const Json& value) {
  if (value.is_boolean()) return "boolean";
  if (value.is_number_integer()) return "integer";
  if (value.is_number()) return "number";
  if (value.is_array()) return "array";
  return value.is_object() ? "object" : "string";
}

}  // namespace

const Schema kPoseSchema{
    .name = "foxglove.PoseInFrame",
    .json = R"({"title":"foxglove.PoseInFrame","type":"object","properties":{)"
            R"("timestamp":{"type":"object","title":"time","properties":{"sec":{"type":"integer"},"nsec":{"type":"integer"}}},)"
            R"("frame_id":{"type":"string"},"pose":{"title":"foxglove.Pose","type":"object","properties":{)"
            R"("position":{"title":"foxglove.Vector3","type":"object",)"
            R"("properties":{"x":{"type":"number"},"y":{"type":"number"},"z":{"type":"number"}}},)"
            R"("orientation":{"title":"foxglove.Quaternion","type":"object",)"
            R"("properties":{"x":{"type":"number"},"y":{"type":"number"},"z":{"type":"number"},"w":{"type":"number"}}}}}}})"};

const Schema kLocationSchema{
    .name = "foxglove.LocationFix",
    .json = R"({"title":"foxglove.LocationFix","type":"object","properties":{)"
            R"("timestamp":{"type":"object","title":"time","properties":{"sec":{"type":"integer"},"nsec":{"type":"integer"}}},)"
            R"("frame_id":{"type":"string"},"latitude":{"type":"number"},"longitude":{"type":"number"},"altitude":{"type":"number"},)"
            R"("position_covariance":{"type":"array","items":{"type":"number"}},"position_covariance_type":{"type":"integer"}}})"};

const Schema kLogSchema{
    .name = "foxglove.Log",
    .json = R"({"title":"foxglove.Log","type":"object","properties":{)"
            R"("timestamp":{"type":"object","title":"time","properties":{"sec":{"type":"integer"},"nsec":{"type":"integer"}}},)"
            R"("level":{"type":"integer"},"message":{"type":"string"},"name":{"type":"string"},"file":{"type":"string"},)"
            R"("line":{"type":"integer"}}})"};

Json pose_in_frame(const messages::Navigation& fix) {
  // Headings go clockwise from north, angles about z counterclockwise from x, which is east.
  const double half_yaw_rad = (std::numbers::pi / 2.0 - fix.heading.value) / 2.0;
  const Json position{{"x", fix.position.east.value}, {"y", fix.position.north.value}, {"z", -fix.depth.value}};
  const Json orientation{{"x", 0.0}, {"y", 0.0}, {"z", std::sin(half_yaw_rad)}, {"w", std::cos(half_yaw_rad)}};
  return {
      {"timestamp", timestamp_of(fix.time)}, {"frame_id", kMissionFrame}, {"pose", {{"position", position}, {"orientation", orientation}}}};
}

std::optional<Json> location_fix(const messages::Navigation& fix, const n2k::LocalPlane& plane) {
  const Result<n2k::Geographic> place = plane.to_geographic(fix.position);
  if (!place.ok()) return std::nullopt;
  constexpr int kCovarianceUnknown = 0;
  return Json{
      {"timestamp", timestamp_of(fix.time)},           {"frame_id", "vehicle"},        {"latitude", place.value().latitude_deg},
      {"longitude", place.value().longitude_deg},      {"altitude", -fix.depth.value}, {"position_covariance", std::vector<double>(9, 0.0)},
      {"position_covariance_type", kCovarianceUnknown}};
}

Json log_of(const Event& event) {
  constexpr int kInformationLevel = 2;  // and behind it warning, error
  return {{"timestamp", timestamp_of(event.time)},
          {"level", kInformationLevel + static_cast<int>(event.severity)},
          {"message", event.text},
          {"name", "earshotd"},
          {"file", ""},
          {"line", 0}};
}

Json schema_of(const Json& example) {
  Json schema{{"type", type_of(example)}};
  if (example.is_array()) schema["items"] = schema_of(example.at(0));
  if (!example.is_object()) return schema;
  Json properties = Json::object();
  for (const auto& [name, value] : example.items()) properties[name] = schema_of(value);
  schema["properties"] = std::move(properties);
  return schema;
}

}  // namespace earshot::journal
