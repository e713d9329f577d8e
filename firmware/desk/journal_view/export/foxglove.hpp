#pragma once

#include <nlohmann/json.hpp>
#include <optional>

#include "firmware/desk/journal_view/events/timeline.hpp"
#include "firmware/messages/navigation.hpp"
#include "firmware/wire/n2k/local_plane.hpp"

namespace earshot::journal {

// Messages that Foxglove and Lichtblick show without a plug-in: on a map, in space, as a log.
// Source: Foxglove SDK, schemas/jsonschema (LocationFix, PoseInFrame, Log): the names of the fields and their meaning.

inline constexpr const char* kMissionFrame = "mission";  ///< x east, y north, z up from the surface, metres

/// A JSON schema and the name by which viewers know what it describes.
struct Schema {
  const char* name = nullptr;
  const char* json = nullptr;
};
extern const Schema kPoseSchema;
extern const Schema kLocationSchema;
extern const Schema kLogSchema;

/// Where the vehicle is in kMissionFrame and where its bow points: x forward, y to port, z up.
/// @param fix  is_usable()
[[nodiscard]] nlohmann::ordered_json pose_in_frame(const messages::Navigation& fix);

/// Where it is on the WGS-84 ellipsoid; its altitude is its depth, negative. Nothing beyond the plane.
/// @param fix  is_usable()
[[nodiscard]] std::optional<nlohmann::ordered_json> location_fix(const messages::Navigation& fix, const n2k::LocalPlane& plane);

[[nodiscard]] nlohmann::ordered_json log_of(const Event& event);

/// The JSON schema of objects such as this one, whose arrays hold an element or more. Nothing is required: what is not known is left out.
[[nodiscard]] nlohmann::ordered_json schema_of(const nlohmann::ordered_json& example);

}  // namespace earshot::journal
