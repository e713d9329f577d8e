#pragma once

#include <cstdint>
#include <optional>

#include "firmware/authority/command.hpp"
#include "firmware/config/mission.hpp"
#include "firmware/core/random.hpp"
#include "firmware/core/time.hpp"
#include "firmware/guidance/fallback.hpp"
#include "firmware/messages/health.hpp"
#include "firmware/messages/operator_command.hpp"
#include "firmware/messages/setpoint.hpp"
#include "firmware/runtime/intake.hpp"
#include "firmware/runtime/legs.hpp"
#include "firmware/runtime/orders.hpp"
#include "firmware/safety/limits.hpp"
#include "firmware/safety/manoeuvre.hpp"
#include "firmware/safety/supervisor.hpp"

namespace earshot::runtime {

/// How far a mission has come: all that changes after configure() but what the belief holds. Owns the state of the mission, what was taken
/// in, the orders, the legs, and what the rules and the operator want of the vehicle. The Runtime keeps it twice.
///
/// Every call is given the mission of the one before, with limits that may have become tighter.
/// Oracle: Progress.*
class Progress {
 public:
  Intake intake;
  Orders orders;
  Legs legs;
  bool is_refining = false;  ///< the belief, on the last measurement
  Pcg32 random{0};           ///< that actions are drawn with
  guidance::Fallback fallback;

  /// The mission can be ordered to begin from now on. @param mission  one that config::check accepts
  void arm(const config::Mission& mission);
  [[nodiscard]] bool is_armed() const { return is_armed_; }
  [[nodiscard]] messages::MissionState state() const { return state_; }
  [[nodiscard]] messages::EndReason end_reason() const { return end_reason_; }
  [[nodiscard]] std::uint64_t turn() const { return turn_; }
  /// Set-points leave, or would if the memory could be trusted.
  [[nodiscard]] bool is_engaged() const { return command_.is_engaged(); }

  void begin_turn() { ++turn_; }
  /// Any order but TIGHTEN.
  [[nodiscard]] messages::CommandOutcome obey(const config::Mission& mission, Time arrival, const messages::OperatorCommand& command);
  /// The mission has tighter limits from now on.
  void tighten(const config::Mission& mission) { supervisor_.tighten(mission); }
  void end(messages::MissionState state, messages::EndReason reason);

  /// A search was ordered, and what it needs is there: navigation, SNR, the autopilot that the mission waits for.
  [[nodiscard]] bool may_begin_search(const config::Mission& mission, Time now) const;
  /// @pre may_begin_search()
  void begin_search(Time now);

  /// Lets the rules judge the search; ends the mission if they say so. @param events  those of this turn are added
  void supervise(const config::Mission& mission, Time now, safety::SafetyEvents& events);
  /// When a mission is over that commands the vehicle: a leak may come after it. @param events  those of this turn
  void watch_for_release(const config::Mission& mission, Time now, safety::SafetyEvents& events);
  /// What a rule or an operator wants of the vehicle in place of its search, the stronger of the two.
  [[nodiscard]] std::optional<config::Response> response() const;

  /// Whether the search has a leg to sail on: its way-point is still to be reached; of a search that only listens: would be.
  [[nodiscard]] bool leg_goes_on(const config::Mission& mission, Time now) const;
  /// The vehicle is taken from its search, to do what response() says.
  void interrupt();
  /// The search goes on, and decides anew from where the vehicle is.
  void decide_anew();
  /// It has decided to go there. @pre a fix was taken
  void begin_leg(const safety::SafeWaypoint& safe, Time now);

  /// What leaves: nothing before a mission commands the vehicle.
  [[nodiscard]] std::optional<messages::Setpoint> setpoint(const config::Mission& mission, Time now);
  /// All but what the belief knows.
  [[nodiscard]] messages::Health health(const config::Mission& mission, Time now) const;

 private:
  [[nodiscard]] messages::Setpoint wanted_setpoint(const config::Mission& mission);

  bool is_armed_ = false;
  messages::MissionState state_ = messages::MissionState::kStandby;
  messages::EndReason end_reason_ = messages::EndReason::kNone;
  std::uint64_t turn_ = 0;
  authority::Command command_;
  safety::Supervisor supervisor_;
  safety::Manoeuvre manoeuvre_;
  std::uint64_t setpoints_limited_ = 0;
};

}  // namespace earshot::runtime
