#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <utility>

#include "firmware/boards/linux/clock.hpp"
#include "firmware/boards/linux/outage/coming_up.hpp"
#include "firmware/boards/linux/outage/safety_log.hpp"
#include "firmware/boards/linux/port.hpp"
#include "firmware/boards/linux/port_set.hpp"
#include "firmware/config/mission.hpp"
#include "firmware/messages/operator_command.hpp"

namespace earshot::board {

/// Commands a vehicle while the journal that its mission goes on from is read again, which takes minutes of a long one: stop and come up.
/// Health says the state that the record says, and that the vehicle comes up. Of what its ports bring an ABORT is obeyed, for good: it
/// stands in the record before it is acknowledged, and is given to the mission when that goes on. All else is not taken. Oracle:
/// Meanwhile.*
class Meanwhile final : public InputSink {
 public:
  using Abort = std::pair<std::uint8_t, messages::OperatorCommand>;  ///< and the port that brought it

  /// All must outlive it. @param safety  of the flight that goes on
  Meanwhile(const config::Mission& mission, PortSet& ports, Clock& clock, SafetyLog& safety)
      : ports_(ports), clock_(clock), safety_(safety), before_(safety.record()), core_(mission, before_) {}

  void take(std::uint8_t port, const Value& value) override;
  /// Reads what the ports bring, and tells them what the vehicle is to do.
  void turn();
  [[nodiscard]] const std::optional<Abort>& abort() const { return abort_; }

 private:
  [[nodiscard]] messages::CommandOutcome obey(std::uint8_t port, const messages::OperatorCommand& command);

  PortSet& ports_;
  Clock& clock_;
  SafetyLog& safety_;
  const host::SafetyRecord before_;
  ComingUp core_;
  runtime::Acknowledgements acknowledgements_;
  std::optional<Abort> abort_;
};

}  // namespace earshot::board
