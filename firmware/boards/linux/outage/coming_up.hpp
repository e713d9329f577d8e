#pragma once

#include <optional>

#include "firmware/boards/linux/core/core.hpp"
#include "firmware/config/mission.hpp"
#include "firmware/core/time.hpp"
#include "firmware/core/units.hpp"
#include "firmware/host/safety_record/safety_record.hpp"
#include "firmware/messages/health.hpp"
#include "firmware/messages/navigation.hpp"
#include "firmware/messages/operator_command.hpp"
#include "firmware/messages/setpoint.hpp"
#include "firmware/runtime/runtime.hpp"
#include "firmware/safety/depth_estimate.hpp"

namespace earshot::board {

/// What commands a vehicle whose mission cannot go on after an outage: nothing but stop and come up, for good. It needs no journal, policy,
/// tables or lock, only the safety record.
///
/// A vehicle that needs speed to come up goes round and round at its ascent speed for as long as one needs that comes up from its deepest
/// at 0.1 m/s: no depth that is told ends it sooner, for it may be wrong. Then it stops; where its depth says that it is below, it tries
/// again (safety::DepthEstimate). It turns by its heading while that is told, and by the time otherwise. One that only listened commands
/// nothing, as before.
///
/// Every order is answered; an ABORT is repeated, and no other is for this state. A leak releases the weight where the mission's rule about
/// it does, and after as long as that. Oracle: ComingUp.*
class ComingUp final : public Core {
 public:
  /// @param mission  with the limits of the record; what else it says is not looked at, but its vehicle and its rule about a leak
  ComingUp(const config::Mission& mission, const host::SafetyRecord& record);

  std::optional<messages::CommandOutcome> take(const messages::Input& input) override;
  [[nodiscard]] runtime::Outputs step(Time now) override;
  [[nodiscard]] const config::Mission& mission() const override { return mission_; }
  /// Whether its time to come up is over, or its depth says that it is up.
  [[nodiscard]] bool has_come_up(Time now) const;

 private:
  [[nodiscard]] messages::Setpoint setpoint(Time now);
  void hear(Time arrival, const messages::Navigation& fix);
  void hear(const messages::Input& input, const messages::VehicleStatus& status);
  /// In place of what the port reported before.
  void keep(const messages::PortReport& report);
  messages::CommandOutcome answer(Time arrival, std::uint8_t port, const messages::OperatorCommand& command);

  config::Mission mission_;
  Duration long_enough_;  ///< to come up from the deepest
  safety::DepthEstimate depth_;
  std::optional<Duration> releases_after_leak_;  ///< of so long
  safety::StandingAlarm leak_;
  std::optional<Time> leaks_since_;
  bool is_engaged_;
  bool is_released_;
  messages::Health health_;
  runtime::Acknowledgements acknowledgements_;
  std::optional<Time> began_;
  std::optional<messages::Navigation> fix_;  ///< the newest, dated with its arrival
};

/// The mission as the record says that it is flown; of one that nobody knows any more, what is needed to come up.
[[nodiscard]] config::Mission limited_by(config::Mission mission, const host::SafetyRecord& record);

}  // namespace earshot::board
