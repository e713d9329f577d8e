#pragma once

#include <cstdint>
#include <span>

#include "firmware/config/capacities.hpp"
#include "firmware/config/mission.hpp"
#include "firmware/core/status.hpp"
#include "firmware/core/time.hpp"
#include "firmware/messages/input.hpp"
#include "firmware/messages/operator_command.hpp"
#include "firmware/policy/frozen_policy.hpp"
#include "firmware/policy/tables/ocean_tables.hpp"
#include "firmware/runtime/orders.hpp"
#include "firmware/runtime/outputs.hpp"
#include "firmware/runtime/progress.hpp"
#include "firmware/runtime/search_agent.hpp"
#include "firmware/runtime/shadow_copy.hpp"

namespace earshot::runtime {

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
  /// Nothing of an earlier mission is left.
  void forget();
  void arm(const config::Mission& mission);
  messages::CommandOutcome judge(const messages::Input& input);
  messages::CommandOutcome take_order(const Orders::Arrival& arrival);
  [[nodiscard]] messages::CommandOutcome tighten(const messages::OperatorLimits& limits);
  void turn(Time now, Outputs& outputs);

  config::Mission mission_;
  SearchAgent agent_;
  Progress progress_;
  ShadowCopy shadow_;  ///< of mission_ and progress_
};

static_assert(sizeof(Runtime) <= config::kRuntimeBytes);

}  // namespace earshot::runtime
