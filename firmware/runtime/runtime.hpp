#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "firmware/config/capacities.hpp"
#include "firmware/config/mission.hpp"
#include "firmware/core/status.hpp"
#include "firmware/core/time.hpp"
#include "firmware/messages/decision.hpp"
#include "firmware/messages/health.hpp"
#include "firmware/messages/input.hpp"
#include "firmware/messages/setpoint.hpp"
#include "firmware/policy/frozen_policy.hpp"
#include "firmware/policy/observation.hpp"
#include "firmware/policy/tables/ocean_tables.hpp"
#include "firmware/runtime/progress.hpp"
#include "firmware/safety/supervisor.hpp"

namespace earshot::runtime {

/// The outputs of one turn of the loop.
struct Outputs {
  std::optional<messages::Setpoint> setpoint;  ///< none until a search begins: the autopilot is somebody else's
  std::optional<messages::Decision> decision;
  Acknowledgements acknowledgements;   ///< of the commands judged since the last turn
  safety::SafetyEvents safety_events;  ///< rules that began to act, or no longer do
  messages::Health health;
};

/// The whole on-vehicle state. step() reads no clock, opens nothing, allocates nothing, throws nothing: same inputs, same outputs, bit for
/// bit.
///
///   STANDBY -- START or LISTEN, fresh navigation and SNR --> SEARCH -- max_steps, COMPLETE --> DONE
///   SEARCH -- the source is found, where the mission ends with that --> DONE
///   SEARCH -- a rule of the safety supervisor that aborts --> ABORT;   any state -- ABORT --> ABORT
///
/// START and LISTEN are remembered until navigation and SNR are there (and the autopilot, where the mission waits for it), or they expire.
/// Once a search commands the vehicle, the set-point says in DONE and ABORT: stop and come up (and release the weight, if a rule says so
/// then or later); before, and while it only listens, nothing
/// is commanded, whatever becomes of the mission.
class Runtime {
 public:
  /// Takes a copy of all and forgets everything else. kOutOfRange if the mission fails config::check, the policy was trained for another
  /// (policy::mismatch) or the tables do not cover it (policy::coverage); what policy::check finds wrong with the policy, by status_of;
  /// kCorrupt if this build does not repeat the policy's golden trajectories or repeats_known_steps(): it would not fly as the policy was
  /// frozen. Until configured, step() stays in STANDBY and refuses START.
  /// @param tables  the oceans that are possible where the mission is; not looked at when the policy holds no belief
  [[nodiscard]] Status configure(const config::Mission& mission, const policy::FrozenPolicy& policy, const policy::OceanTables& tables);

  /// The same from the bytes of the `.policy` and `.tables` files, which are read where they are to stay: for a machine without room for
  /// both a second time. What policy::parse refuses is refused with its status. @param tables  empty where the policy needs none
  [[nodiscard]] Status configure(const config::Mission& mission, std::span<const std::uint8_t> policy,
                                 std::span<const std::uint8_t> tables);

  /// Judges one input; any number between two steps, in the order in which they came. What is refused changes nothing but its counter, so
  /// that a bad sender does not hide a good one. Of several ports that bring one kind, the latest date counts; but fixes are taken from one
  /// port at a time (safety::NavigationJudge), and those of another only held against it.
  /// Navigation and SNR are refused when dated further from their arrival than their timeout, and when older than the last; a date ahead
  /// of its arrival counts as the arrival. Bearings likewise, by the SNR's timeout; of two senders the first holds
  /// (detector::BearingWindow).
  /// ABORT ends the mission here and now, whatever its date: no order before or after it in the same turn can undo it.
  /// @return what became of an order; kObeyed of any other input
  messages::CommandOutcome take(const messages::Input& input);

  /// The mission as it is flown: with the limits that an operator made tighter.
  [[nodiscard]] const config::Mission& mission() const { return mission_; }

  /// One turn of the loop, with all that has been taken. `now` never goes back (over take() and step()) and is not negative.
  [[nodiscard]] Outputs step(Time now);

  // Mission, limits, state, latches and timers are kept twice, policy, tables and memory of the search with a CRC-32. A bit that flips in
  // them is noticed by the next take() or step(), or the next decision, before it is used: the mission ends (kMemoryFault), for good.

 private:
  /// What decides about the vehicle, once more.
  struct ShadowCopy {
    bool configured = false;
    config::Mission mission;
    Progress progress;
  };

  /// Whether nothing of what changes has changed since the shadow copy was made, by the bytes.
  [[nodiscard]] bool is_intact() const;
  void update_shadow();
  void update_shadow_of_mission();
  /// Whether policy, tables and memory of the search are what they were after the last decision.
  [[nodiscard]] bool may_decide() const;
  /// What is left to say when the memory cannot be trusted.
  void step_of_damaged(Time now, Outputs& outputs) const;

  void forget();
  /// Whether mission and policy fit each other, and this build flies it as it was frozen. Works in memory_ and tables_.
  [[nodiscard]] Status judge_search(const config::Mission& mission, const policy::FrozenPolicy& policy);
  void arm(const config::Mission& mission);

  messages::CommandOutcome judge(const messages::Input& input);
  void turn(Time now, Outputs& outputs);
  messages::CommandOutcome take_command(Time arrival, std::uint8_t port, const messages::OperatorCommand& command);
  [[nodiscard]] messages::CommandOutcome obey(Time arrival, const messages::OperatorCommand& command);
  void acknowledge(const messages::CommandAcknowledgement& acknowledgement);
  void end(messages::MissionState state, messages::EndReason reason);
  [[nodiscard]] bool navigation_is_fresh(Time now) const;
  [[nodiscard]] bool snr_is_fresh(Time now) const;
  [[nodiscard]] bool autopilot_is_connected(Time now) const;
  [[nodiscard]] messages::CommandOutcome tighten(const messages::OperatorLimits& limits);
  /// What a rule or an operator wants of the vehicle in place of its search, the stronger of the two.
  [[nodiscard]] std::optional<config::Response> response() const;
  /// Whether the way-point is still to be reached; of a search that only listens: whether it would be.
  [[nodiscard]] bool leg_goes_on(Time now) const;
  /// Lets the supervisor look; ends the mission if it says so.
  void supervise(Time now, Outputs& outputs);
  /// When a mission is over that commands the vehicle: a leak may come after it.
  void watch_for_release(Time now, Outputs& outputs);
  [[nodiscard]] NorthEast place_in_area() const;
  [[nodiscard]] policy::Reception reception(Time now) const;
  [[nodiscard]] Time before_newest_measurement() const;
  [[nodiscard]] std::optional<messages::Bearing> bearing(Time now) const;
  [[nodiscard]] bool has_belief() const { return policy::needs_belief(policy_.observation.spec); }
  [[nodiscard]] messages::BeliefSummary belief() const;
  [[nodiscard]] std::optional<messages::FoundDeclaration> found() const;
  [[nodiscard]] std::size_t choose(NorthEast position, std::span<const float> logits);
  void begin_search(Time now);
  void search(Time now, Outputs& outputs);
  /// On a leg: what the belief makes of all that was heard until the next decision, a slice a turn.
  void refine();
  [[nodiscard]] bool decide(Time now, const policy::Reception& reception, messages::Decision& decision);
  [[nodiscard]] messages::Setpoint wanted_setpoint();
  [[nodiscard]] std::optional<messages::Setpoint> setpoint(Time now);
  [[nodiscard]] messages::Health health(Time now) const;

  /// Any other number: its memory was found damaged.
  static constexpr std::uint64_t kIntact = 0x5A3C'96E1'0F78'B42DU;

  bool configured_ = false;
  config::Mission mission_;
  policy::FrozenPolicy policy_;
  policy::OceanTables tables_;
  policy::SearchMemory memory_;  ///< begins anew with every search; too large to be assigned by way of the stack
  Progress progress_;
  ShadowCopy shadow_;
  std::uint64_t integrity_ = kIntact;
  std::uint32_t policy_checksum_ = 0;
  std::uint32_t tables_checksum_ = 0;
  std::uint32_t memory_checksum_ = 0;  ///< since the last decision
};

static_assert(sizeof(Runtime) <= config::kRuntimeBytes);

}  // namespace earshot::runtime
