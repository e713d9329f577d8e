#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <utility>

#include "firmware/boards/linux/clock/clock.hpp"
#include "firmware/boards/linux/outage/coming_up.hpp"
#include "firmware/boards/linux/outage/safety_log.hpp"
#include "firmware/boards/linux/port/port.hpp"
#include "firmware/boards/linux/port/port_set.hpp"
#include "firmware/config/mission.hpp"
#include "firmware/messages/operator_command.hpp"

namespace earshot::board {

/// Commands a vehicle while the journal that its mission goes on from is read again, which takes minutes of a long one: stop and come up.
/// Health says the state that the record says, and that the vehicle comes up. Of what its ports bring an ABORT is obeyed, for good: it
/// stands in the record before it is acknowledged, and is given to the mission when that goes on. A weight that a leak releases stands
/// there before it is told. All else is not taken.
///
/// Then it commands on until the mission, which goes on but waits for its sensors, has made its first turn: what the ports bring is the
/// mission's from there on (pass_on_to()). Oracle: Meanwhile.*
class Meanwhile final : public InputSink {
 public:
  using Abort = std::pair<std::uint8_t, messages::OperatorCommand>;  ///< and the port that brought it

  /// All must outlive it. @param safety  of the flight that goes on
  Meanwhile(const config::Mission& mission, PortSet& ports, Clock& clock, SafetyLog& safety)
      : ports_(ports), clock_(clock), safety_(safety), before_(safety.record()), core_(mission, before_) {}

  void take(std::uint8_t port, const Value& value) override;
  void report_detection(std::uint8_t port, const messages::SoundDetection& detection) override;
  void report_chain(std::uint8_t port, const HeardChain& chain) override;
  void report_trouble(std::uint8_t port, BusTrouble trouble, bool is_there) override;
  void report_order_trouble(std::uint8_t port, OrderTrouble trouble) override;
  /// Reads what the ports bring, and tells them what the vehicle is to do.
  void turn();
  /// Tells them again what it is to do.
  void publish_state();
  /// From now on the mission takes whatever comes, orders too, and this only looks at the vehicle's heading. @param mission  must outlive
  /// it
  void pass_on_to(InputSink& mission) { mission_ = &mission; }
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
  InputSink* mission_ = nullptr;  ///< that has been read again
};

}  // namespace earshot::board
