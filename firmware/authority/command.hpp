#pragma once

#include <optional>

#include "firmware/config/authority.hpp"
#include "firmware/core/time.hpp"
#include "firmware/messages/autopilot_status.hpp"
#include "firmware/messages/health.hpp"
#include "firmware/messages/operator_command.hpp"

namespace earshot::authority {

/// Whether a mission commands the vehicle, or is to: what its operators' orders have made of it.
///
///   DISCONNECTED <-- the autopilot's status --> STANDBY -- LISTEN --> LISTEN -- START --> COMMAND -- any abort --> ABORT
///                                                STANDBY -- START -----------------------^
class Command {
 public:
  /// Orders that begin, pause or resume a search: START, LISTEN, PAUSE, RESUME.
  /// @param is_connected  the autopilot is heard, or is not waited for
  [[nodiscard]] messages::CommandOutcome obey(const messages::OperatorCommand& command, messages::MissionState state, bool is_connected);

  /// Whether a search was ordered that has not begun, and whose order has not expired.
  [[nodiscard]] bool is_search_ordered(Time now) const { return until_ && now <= *until_; }
  /// The search that was ordered begins.
  void begin();

  /// Set-points leave: the autopilot is ours, and stays so when the mission ends.
  [[nodiscard]] bool is_engaged() const { return is_engaged_; }
  [[nodiscard]] bool is_paused() const { return is_paused_; }

 private:
  [[nodiscard]] messages::CommandOutcome order_search(const messages::OperatorCommand& command, messages::MissionState state,
                                                      bool is_connected);

  std::optional<Time> until_;  ///< a search was ordered, and waits for what it needs until then
  bool is_to_listen_ = false;  ///< it is to command nothing
  bool is_engaged_ = false;
  bool is_paused_ = false;
};

/// Whether the mission's autopilot is heard, or none is waited for.
[[nodiscard]] bool is_connected(const config::Authority& settings, const std::optional<messages::AutopilotStatus>& autopilot, Time now);

[[nodiscard]] messages::Authority state_of(const Command& command, messages::MissionState state, bool is_connected);

}  // namespace earshot::authority
