#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

#include "firmware/config/capacities.hpp"
#include "firmware/core/fixed_vector.hpp"
#include "firmware/core/geometry.hpp"
#include "firmware/core/time.hpp"
#include "firmware/core/units.hpp"

namespace earshot::config {

// What the safety supervisor keeps, whatever the policy says: plain data of the mission, like everything in mission.hpp.

/// What a rule does once its condition has lasted, from the mildest to the strongest. Of those that are in force the strongest acts.
enum class Response : std::uint8_t {
  kWarn = 0,       ///< it is told; the search goes on
  kSteerBack = 1,  ///< steers back into the fence; a turn that has begun keeps its side
  kHold = 2,       ///< stays where it is, as well as the vehicle can
  kReturn = 3,     ///< goes to the safe point at the search's depth, and holds there
  kSurface = 4,    ///< leaves a zone where it may not surface, and comes up
  kAbort = 5,      ///< ends the mission for good, and comes up where it is
  kRelease = 6,    ///< likewise, and asks for the drop weight to be released
};
inline constexpr std::size_t kResponses = 7;
/// How a response is called, everywhere.
struct ResponseTraits {
  Response response{};
  std::string_view key;   ///< in files, and in lines about a rule
  std::string_view name;  ///< on CAN and in tables
  std::string_view deed;  ///< for people: what is done, before "once"
};
/// In the order of Response; firmware/messages/dictionary/complete.cpp does not compile while one has no row.
inline constexpr std::array<ResponseTraits, kResponses> kResponseTraits{{
    {Response::kWarn, "warn", "warn", "warn"},
    {Response::kSteerBack, "steer_back", "steer back", "steer back into the fence"},
    {Response::kHold, "hold", "hold", "hold the place"},
    {Response::kReturn, "return", "return", "return to the safe point"},
    {Response::kSurface, "surface", "surface", "surface"},
    {Response::kAbort, "abort", "abort", "abort"},
    {Response::kRelease, "release", "release", "abort and ask for the drop weight to be released"},
}};

/// What a rule watches: one number each, of which too much (or too little) is a fault.
enum class Condition : std::uint8_t {
  kNavigationAge,        ///< since the newest fix that was taken
  kNavigationJump,       ///< how far the fixes that are refused lie from where the vehicle can be
  kNavigationFrozen,     ///< for how long fixes have said one place while the vehicle should move
  kSnrAge,               ///< since the newest measurement
  kVehicleStatusAge,     ///< since the newest vehicle status; without one, since the search began
  kAutopilotAge,         ///< since the newest autopilot status; without one, since the search began
  kOperatorAge,          ///< since the newest message of any operator
  kOutsideFence,         ///< how far beyond the save polygon, or where it will be when it has turned round
  kOutsideHalt,          ///< how far beyond the halt polygon (without a fence: the operating area)
  kDepth,                ///< the vehicle's own
  kAltitude,             ///< above the sea floor
  kSpeed,                ///< through the water
  kTurnRate,             ///< of the heading between two fixes
  kSearchTime,           ///< since the search began
  kDistanceTravelled,    ///< over ground since the search began
  kBattery,              ///< charge that is left
  kBatteryAtHome,        ///< charge that will be left at the safe point
  kLeak,                 ///< water in the hull
  kGroundFault,          ///< current between battery and hull
  kHydrophoneDeaf,       ///< the hydrophone says that it hears nothing
  kAutopilotDisengaged,  ///< the autopilot reports that it follows no set-points
  kHeadingIgnored,       ///< between heading and set-point
  kDepthIgnored,         ///< between depth and set-point
  kNoProgress,           ///< since the vehicle last came nearer to its way-point
  kPolicyUnhealthy,      ///< the policy gave no number, or was shown an observation that it cannot have been trained on
  kNavigationDisputed,   ///< how far fixes that come late lie from those that were believed of their time
  kPlaceUnexplained,     ///< how much further the place went than speed, heading and current can have taken it
  kDepthUnexplained,     ///< how far the depth lies from where the set-points can have brought the vehicle
  kSetpointsUnsent,      ///< for how long no set-point could be sent
};
inline constexpr std::size_t kConditions = 29;

/// One line of the supervisor's list: `response` acts once `condition` has been beyond `limit` for `persistence`.
struct Rule {
  Condition condition = Condition::kNavigationAge;
  double limit = 0.0;  ///< in the condition's unit (ConditionTraits); zero of one that is only true or false
  Duration persistence;
  Response response = Response::kWarn;
  bool is_latched = false;  ///< once it acts, it acts until the mission ends
  friend constexpr bool operator==(const Rule&, const Rule&) = default;
};

/// What a rule's file and a rule's words need to know of its condition.
struct ConditionTraits {
  enum class Kind : std::uint8_t {
    kAbove,  ///< beyond the limit is more than it
    kBelow,  ///< beyond the limit is less than it
    kFlag,   ///< it is or it is not: there is no limit
  };
  std::string_view key;      ///< in files; its end is the unit
  std::string_view meaning;  ///< in words, before "is above 5"
  Kind kind = Kind::kAbove;
  double lowest = 0.0;  ///< limit
  double highest = 0.0;
};

/// Fixes a second apart tell up to 180 degrees a second, and make slower what is faster (190 look like 170). All from this limit to three
/// times as fast look faster than it.
inline constexpr double kMostTurnRateLimit_deg_per_s = 90.0;

/// In the order of Condition.
inline constexpr std::array<ConditionTraits, kConditions> kConditionTraits{{
    {"navigation_age_s", "the age of the newest fix", ConditionTraits::Kind::kAbove, 1e-6, 3600.0},
    {"navigation_jump_m", "the distance of refused fixes from where the vehicle can be", ConditionTraits::Kind::kAbove, 0.0, 1e6},
    {"navigation_frozen_s", "the time for which fixes give one place although the vehicle should move", ConditionTraits::Kind::kAbove, 0.5,
     3600.0},
    {"snr_age_s", "the age of the newest SNR", ConditionTraits::Kind::kAbove, 1e-6, 3600.0},
    {"vehicle_status_age_s", "the age of the newest vehicle status", ConditionTraits::Kind::kAbove, 0.5, 3600.0},
    {"autopilot_age_s", "the age of the newest autopilot status", ConditionTraits::Kind::kAbove, 0.5, 3600.0},
    {"operator_age_s", "the time since an operator was heard", ConditionTraits::Kind::kAbove, 0.5, 1e7},
    {"outside_fence_m", "the distance beyond the save polygon, now or after turning round,", ConditionTraits::Kind::kAbove, 0.0, 1e6},
    {"outside_halt_m", "the distance beyond the halt polygon", ConditionTraits::Kind::kAbove, 0.0, 1e6},
    {"depth_m", "the vehicle's depth", ConditionTraits::Kind::kAbove, 0.0, 11'000.0},
    {"altitude_m", "the height above the sea floor", ConditionTraits::Kind::kBelow, 0.0, 11'000.0},
    {"speed_mps", "the speed through the water", ConditionTraits::Kind::kAbove, 0.0, 20.0},
    {"turn_rate_deg_per_s", "the rate of turn", ConditionTraits::Kind::kAbove, 0.0, kMostTurnRateLimit_deg_per_s},
    {"search_time_s", "the time since the search began", ConditionTraits::Kind::kAbove, 1e-6, 1e7},
    {"distance_m", "the distance travelled", ConditionTraits::Kind::kAbove, 0.0, 1e8},
    {"battery_percent", "the battery's charge", ConditionTraits::Kind::kBelow, 0.0, 100.0},
    {"battery_at_home_percent", "the charge that will be left at the safe point", ConditionTraits::Kind::kBelow, 0.0, 100.0},
    {"leak", "there is water in the hull", ConditionTraits::Kind::kFlag, 0.0, 0.0},
    {"ground_fault", "there is a ground fault", ConditionTraits::Kind::kFlag, 0.0, 0.0},
    {"hydrophone_deaf", "the hydrophone reports that it is deaf", ConditionTraits::Kind::kFlag, 0.0, 0.0},
    {"autopilot_disengaged", "the autopilot reports that it follows no set-points", ConditionTraits::Kind::kFlag, 0.0, 0.0},
    {"heading_ignored_deg", "the angle between heading and set-point", ConditionTraits::Kind::kAbove, 0.0, 180.0},
    {"depth_ignored_m", "the distance between depth and set-point", ConditionTraits::Kind::kAbove, 0.0, 11'000.0},
    {"no_progress_s", "the time since the vehicle last came nearer to its way-point", ConditionTraits::Kind::kAbove, 1.0, 1e7},
    {"policy_unhealthy", "the policy gives no number, or saw what it was never trained on", ConditionTraits::Kind::kFlag, 0.0, 0.0},
    {"navigation_disputed_m", "the distance of late fixes from those believed of the same moment", ConditionTraits::Kind::kAbove, 0.0, 1e6},
    {"place_unexplained_m", "how much further the place went than speed, heading and current explain", ConditionTraits::Kind::kAbove, 0.0,
     1e6},
    {"depth_unexplained_m", "the distance of the depth from where set-points can have brought the vehicle", ConditionTraits::Kind::kAbove,
     0.0, 11'000.0},
    {"setpoints_unsent_s", "the time for which no set-point could be sent", ConditionTraits::Kind::kAbove, 0.5, 3600.0},
}};

/// No vehicle that is able to come up does so more slowly, or faster.
inline constexpr MetersPerSecond kSlowestAscent{0.1};
inline constexpr MetersPerSecond kFastestAscent{5.0};

/// How the vehicle moves, as far as the supervisor must know. Not known: what stands here, which asks for nothing.
struct VehicleLimits {
  MetersPerSecond max_speed{20.0};              ///< through the water; no fix is believed that needs more
  MetersPerSecond max_current{0.0};             ///< of the water over ground, anywhere in the area
  Meters turn_radius{0.0};                      ///< of its tightest turn at search speed
  MetersPerSecond hold_speed{0.0};              ///< that it must keep to obey its rudders; 0: it can hover
  MetersPerSecond ascent_speed{0.0};            ///< that it must keep to come up; 0: it floats up by itself
  MetersPerSecond ascent_rate{kSlowestAscent};  ///< upwards, that it then makes at the least
  Meters surface_depth{2.0};                    ///< it is at the surface, its antenna out of the water, when it says no more than this
  double battery_percent_per_km = 0.0;          ///< through the water, at search speed
  friend constexpr bool operator==(const VehicleLimits&, const VehicleLimits&) = default;
};

using Polygon = FixedVector<NorthEast, kMaxPolygonCorners>;

/// Where the vehicle may be: three polygons around each other.
struct Fence {
  Polygon inside;  ///< a vehicle that was steered back is free again here
  Polygon save;    ///< leaving it, the vehicle is steered back
  Polygon halt;    ///< leaving it ends the mission
  friend constexpr bool operator==(const Fence&, const Fence&) = default;
};

struct Safety {
  std::optional<Fence> fence;
  FixedVector<Polygon, kMaxNoSurfaceZones> no_surface;
  std::optional<NorthEast> safe_point;
  VehicleLimits vehicle;
  FixedVector<Rule, kMaxOwnRules> rules;  ///< besides those that no mission can switch off
  friend constexpr bool operator==(const Safety&, const Safety&) = default;
};

}  // namespace earshot::config
