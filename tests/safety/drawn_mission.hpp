#pragma once

#include <cstdint>
#include <memory>
#include <string_view>

#include "firmware/config/mission.hpp"
#include "firmware/core/time.hpp"
#include "firmware/policy/frozen_policy.hpp"

namespace earshot::campaign {

/// What goes wrong in a mission, from some moment on.
enum class Fault : std::uint8_t {
  kNone,
  // What a mission must live with.
  kStrayFix,      ///< one fix from anywhere
  kFixAhead,      ///< a second sender whose clock is fast: a fix of the place where it began, dated 2.3 s ahead, every 2 s
  kLateFixes,     ///< each arrives half its timeout late
  kPoorFix,       ///< one that is not finite
  kOldOrder,      ///< an order from an hour ago
  kShortSilence,  ///< navigation and SNR away for a little less than their timeouts
  kPause,         ///< an operator pauses it for some minutes
  kListenFirst,   ///< it only listens until then
  kTightened,     ///< an operator tightens all limits
  kLowBattery,    ///< a rule sends it home
  // What may end it.
  kOutwardWaypoints,  ///< way-points lie beyond the fence: nothing but the fence itself keeps the vehicle in
  // What must end it.
  kNoFix,         ///< navigation falls silent
  kFrozenFix,     ///< it goes on saying one place
  kSecondSender,  ///< every other fix comes from far away
  kNoSnr,         ///< the SNR falls silent
  kAbortOrder,    ///< somebody aborts it
  kPolicyIsNoNumber,
  kLeak,         ///< water in the hull, and a rule about it
  kStuck,        ///< the vehicle stands still, and its fixes shiver
  kSinks,        ///< it goes down whatever it is told
  kCarriedAway,  ///< a current three times as fast as it can swim carries it off
};
inline constexpr std::size_t kFaults = 22;
[[nodiscard]] std::string_view to_string(Fault fault);
[[nodiscard]] constexpr bool may_end(Fault fault) {
  return fault >= Fault::kOutwardWaypoints;
}
/// The vehicle no longer moves as its mission says it does.
[[nodiscard]] constexpr bool breaks_vehicle(Fault fault) {
  return fault >= Fault::kStuck;
}

/// How the true vehicle moves; within what its mission says of it.
struct Vehicle {
  double top_speed_mps = 2.0;
  double turn_radius_m = 0.0;  ///< of its tightest turn; 0: on the spot
  double current_north_mps = 0.0;
  double current_east_mps = 0.0;
  double climb_mps = 0.5;
};

struct DrawnMission {
  config::Mission mission;
  std::unique_ptr<policy::FrozenPolicy> policy;
  std::string_view policy_kind;
  NorthEast start;
  double battery_at_home_percent = 0.0;  ///< below it, a rule sends the vehicle home
  Vehicle vehicle;
  Fault fault = Fault::kNone;
  Duration fault_after;  ///< of the search's beginning
};

/// The mission of one seed: area, fence, limits, vehicle, policy, fault.
[[nodiscard]] DrawnMission draw(std::uint64_t seed);

/// A number that stands among the policy's weights and nowhere else: who finds it in a Runtime has found the policy.
inline constexpr float kWatermark = 0.73912847F;

}  // namespace earshot::campaign
