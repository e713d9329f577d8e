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
#include "firmware/guidance/leg.hpp"
#include "firmware/guidance/setpoint.hpp"
#include "firmware/policy/frozen_policy.hpp"
#include "firmware/policy/observation.hpp"

namespace earshot::runtime {

/// Where the vehicle is, as its navigation says. Frame: the mission's north-east plane. Times are not negative.
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
  bool measured = true;  ///< false: too faint to measure; the signal lies somewhere below `snr`, the least that could have been measured
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

/// Inputs of one step where at most one of each kind arrives between two; a bus that may bring more gives each to Runtime::take() instead.
struct Inputs {
  std::optional<Navigation> navigation = std::nullopt;
  std::optional<SnrEstimate> snr = std::nullopt;
  std::optional<OperatorCommand> command = std::nullopt;
};

using guidance::Setpoint;

/// Why the vehicle goes where it goes: one record per action.
struct Decision {
  std::uint32_t step = 0;  ///< 0 for the first action
  Time time;
  NorthEast position;
  Decibels snr;
  bool measured = true;  ///< false: the signal lies somewhere below `snr`
  bool detected = false;
  std::uint8_t action = 0;
  bool overridden = false;  ///< the safety layer changed the way-point
  NorthEast waypoint;
  std::uint8_t observation_size = 0;
  std::uint8_t action_count = 0;
  std::array<float, config::kMaxObservation> observation{};
  std::array<float, config::kMaxActions> logits{};
  std::optional<policy::BeliefSummary> belief;  ///< in the mission's frame; absent when the policy holds none
};

/// Counters of what was refused; they only grow.
struct Counters {
  std::uint32_t navigation_refused = 0;  ///< not finite, older than the last, or from further ahead than its timeout
  std::uint32_t snr_refused = 0;         ///< likewise, or beyond +-1000 dB
  std::uint32_t commands_refused = 0;    ///< not allowed in this state, or not a command
  std::uint32_t setpoints_limited = 0;   ///< way-points and set-points changed by the safety layer
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
///
///   STANDBY -- kStart, fresh navigation and SNR --> SEARCH -- max_steps, kComplete --> DONE
///   SEARCH -- navigation or SNR stale, outside the operating area, max_time --> ABORT;   any state -- kAbort --> ABORT
///
/// kStart is remembered until navigation and SNR are there. Outside SEARCH the set-point says: stop and come up.
class Runtime {
 public:
  /// Takes a copy of both and forgets everything else. kOutOfRange if the mission fails config::check, the policy is empty, or it was
  /// trained for another mission (policy::misfit). Until configured, step() stays in STANDBY and refuses kStart.
  [[nodiscard]] Status configure(const config::Mission& mission, const policy::FrozenPolicy& policy);

  /// Takes one input, which arrived at `now`; any number of each kind between two steps, in the order in which they came. What is refused
  /// changes nothing but its counter, so that a bad sender does not hide a good one. kAbort ends the mission here and now: no order before
  /// or after it in the same turn can undo it.
  void take(Time now, const Navigation& navigation);
  void take(Time now, const SnrEstimate& estimate);
  void take(Time now, OperatorCommand command);

  /// One turn of the loop, with all that has been taken. `now` never goes back (over take() and step()) and is not negative.
  [[nodiscard]] Outputs step(Time now);
  /// Takes navigation, SNR and command, in this order, then step(now).
  [[nodiscard]] Outputs step(Time now, const Inputs& inputs);

 private:
  /// All that changes after configure().
  struct Progress {
    MissionState state = MissionState::kStandby;
    EndReason end_reason = EndReason::kNone;
    bool start_wanted = false;
    Time search_began;
    std::uint32_t steps_taken = 0;
    std::optional<Navigation> navigation;
    std::optional<SnrEstimate> snr;
    guidance::Leg leg;
    Pcg32 random{0};
    Counters counters;
  };

  void end(MissionState state, EndReason reason);
  [[nodiscard]] bool navigation_is_fresh(Time now) const;
  [[nodiscard]] bool snr_is_fresh(Time now) const;
  [[nodiscard]] EndReason reason_to_abort(Time now) const;
  [[nodiscard]] NorthEast place_in_area() const;
  [[nodiscard]] policy::Heard heard() const;
  [[nodiscard]] policy::BeliefSummary belief() const;
  void begin_search(Time now);
  void search(Time now, Outputs& outputs);
  void decide(Time now, Decision& decision);
  [[nodiscard]] Setpoint setpoint();

  bool configured_ = false;
  config::Mission mission_;
  policy::FrozenPolicy policy_;
  policy::SearchMemory memory_;  ///< begins anew with every search; too large to be assigned by way of the stack
  Progress progress_;
};

static_assert(sizeof(Runtime) <= config::kRuntimeBytes);

}  // namespace earshot::runtime
