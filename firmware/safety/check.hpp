#pragma once

#include <cstddef>
#include <cstdint>

#include "firmware/config/mission.hpp"
#include "firmware/core/polygon.hpp"
#include "firmware/core/units.hpp"

namespace earshot::safety {

enum class SafetyFault : std::uint8_t {
  kNone = 0,
  kVehicle,             ///< a number of the vehicle's is not finite or negative, or they contradict each other or the search's speed
  kFence,               ///< `polygon` says what is wrong with the fence's polygon `index` (0 inside, 1 save, 2 halt)
  kZone,                ///< the same of a zone where it may not surface
  kInsideBeyondSave,    ///< the polygon inside does not lie in the save polygon
  kSaveNearHalt,        ///< the save polygon does not keep margin_to_halt from the halt polygon
  kSearchBeyondFence,   ///< way-points may lie outside the polygon inside
  kSafePoint,           ///< not finite, outside the polygon inside (or the operating area), or in a zone where it may not surface
  kRuleUnknown,         ///< rule `index`: its condition or response is none that this build knows
  kRuleLimit,           ///< its limit or persistence lies outside its range
  kRuleNeedsFence,      ///< it steers back and there is no fence
  kRuleNeedsSafePoint,  ///< it returns, or watches the way home, and there is no safe point
  kRuleNeverActs,       ///< rule `other` does as much, and sooner
};

/// What is wrong with the safety part of a mission.
struct SafetyComplaint {
  SafetyFault fault = SafetyFault::kNone;
  std::size_t index = 0;  ///< of polygon or rule; a rule's is its place in Safety::rules
  std::size_t other = 0;  ///< of a rule that stands in its way: its place in rules_of
  PolygonComplaint polygon = {};
  [[nodiscard]] bool is_none() const { return fault == SafetyFault::kNone; }
};

/// @param mission  one that config::check accepts
/// Oracle: SafetyCheck.*
[[nodiscard]] SafetyComplaint check(const config::Mission& mission);

/// How far a vehicle may get beyond the save polygon before it is back, at the most: it goes straight out, no fix comes until they count as
/// stale, and then it turns; or it turns round in a fence that is narrower than its circle.
///
///   margin = max((v + c) (t_fix + t), R (1 + (pi/2) k)) + R (1 + (pi/2) k + 0.571 k^2),   k = c / v
///
/// v: search speed, c: strongest current, t_fix: navigation timeout, t: kReaction, R: turn radius. The turn from straight out is over when
/// the vehicle swims back as fast as the current carries it out, after pi/2 + asin(k): R (sqrt(1 - k^2) + k (pi/2 + asin k)), which the
/// last term of the margin is never below, for any k up to 1. In an acute corner, or a strip, it goes along the edge when it begins to turn
/// and beside it has turned by pi + asin(k): that takes R (1 + (pi/2) k) more, and no way straight out comes before it.
/// Oracle: SafetyCheck.AsksForRoomToTurnRoundBetweenSaveAndHalt, FenceFlights.*
[[nodiscard]] Meters margin_to_halt(const config::Mission& mission);

}  // namespace earshot::safety
