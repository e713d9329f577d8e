#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "firmware/config/capacities.hpp"
#include "firmware/config/mission.hpp"
#include "firmware/core/geometry.hpp"
#include "firmware/core/random.hpp"
#include "firmware/core/status.hpp"
#include "firmware/core/time.hpp"
#include "firmware/core/units.hpp"
#include "firmware/policy/frozen_policy.hpp"

namespace earshot::runtime {

/// Where the vehicle is, as its navigation says. Frame: the mission's north-east plane.
struct Navigation {
  Time time;  ///< when it was valid
  NorthEast position;
  Meters depth;           ///< positive down
  Radians heading;        ///< clockwise from north
  MetersPerSecond speed;  ///< through the water
};

/// The SNR at the hydrophone: from the detector at sea, from the PE model over the simulation link.
struct SnrEstimate {
  Time time;
  Decibels snr;
};

enum class OperatorCommand : std::uint8_t {
  kStart = 1,     ///< STANDBY -> SEARCH
  kComplete = 2,  ///< SEARCH -> DONE: the source is reached (only an operator or the simulator can know)
  kAbort = 3,     ///< any -> ABORT
};

enum class MissionState : std::uint8_t { kStandby = 0, kSearch = 1, kDone = 2, kAbort = 3 };

enum class EndReason : std::uint8_t {
  kNone = 0,
  kCompleted = 1,    ///< operator said the source is reached
  kStepsUsedUp = 2,  ///< max_steps actions taken
  kOperatorAbort = 3,
  kNavigationStale = 4,
  kSnrStale = 5,
  kLeftOperatingArea = 6,
  kTimeUsedUp = 7,
};

/// Everything that arrived since the last step; the newest of each kind.
struct Inputs {
  std::optional<Navigation> navigation;
  std::optional<SnrEstimate> snr;
  std::optional<OperatorCommand> command;
};

/// What the autopilot is to do.
struct Setpoint {
  Radians heading;
  MetersPerSecond speed;
  Meters depth;
  NorthEast waypoint;
};

/// Why the vehicle goes where it goes: one record per action.
struct Decision {
  std::uint32_t step = 0;  ///< 0 for the first action
  Time time;
  NorthEast position;
  Decibels snr;
  bool detected = false;
  std::uint8_t action = 0;
  bool overridden = false;  ///< the safety layer changed the way-point
  NorthEast waypoint;
  std::uint8_t observation_size = 0;
  std::uint8_t action_count = 0;
  std::array<float, config::kMaxObservation> observation{};
  std::array<float, config::kMaxActions> logits{};
};

/// Counters of what was refused; they only grow.
struct Counters {
  std::uint32_t navigation_refused = 0;  ///< not finite, or older than the last
  std::uint32_t snr_refused = 0;
  std::uint32_t commands_refused = 0;   ///< not allowed in this state
  std::uint32_t setpoints_limited = 0;  ///< changed by the safety layer
};

struct Outputs {
  MissionState state = MissionState::kStandby;
  EndReason end_reason = EndReason::kNone;
  Setpoint setpoint;
  std::optional<Decision> decision;
  std::uint32_t steps_taken = 0;
  Counters counters;
};

/// The whole on-vehicle state. step() reads no clock, opens nothing, allocates nothing, throws nothing: same inputs, same outputs, bit for
/// bit.
class Runtime {
 public:
  /// kOutOfRange if the mission fails config::check or does not fit the policy (step length). Until configured, step() stays in STANDBY.
  [[nodiscard]] Status configure(const config::Mission& mission, const policy::FrozenPolicy& policy);

  /// One turn of the loop. `now` never goes back.
  [[nodiscard]] Outputs step(Time now, const Inputs& inputs);
};

}  // namespace earshot::runtime
