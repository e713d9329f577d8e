#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>

#include "firmware/boards/linux/clock/clock.hpp"
#include "firmware/boards/linux/port/bus_trouble.hpp"
#include "firmware/boards/linux/port/heard_chain.hpp"
#include "firmware/boards/linux/port/order_trouble.hpp"
#include "firmware/core/time.hpp"
#include "firmware/host/mission/port_settings.hpp"
#include "firmware/messages/input.hpp"
#include "firmware/messages/operator_command.hpp"
#include "firmware/messages/port_report.hpp"
#include "firmware/messages/sound_detection.hpp"
#include "firmware/runtime/runtime.hpp"

namespace earshot::board {

/// Takes what the ports bring, one by one in the order in which it came.
class InputSink {
 public:
  using Value = decltype(messages::Input::value);

  InputSink() = default;
  virtual ~InputSink() = default;
  InputSink(const InputSink&) = delete;
  InputSink& operator=(const InputSink&) = delete;

  /// @param value  its date on the mission clock
  virtual void take(std::uint8_t port, const Value& value) = 0;
  /// A sound heard from its beginning to its end. It is told, and steers nothing.
  virtual void report_detection(std::uint8_t /*port*/, const messages::SoundDetection& /*detection*/) {}
  /// With what chain sound is heard from now on, or why it is not.
  virtual void report_chain(std::uint8_t /*port*/, const HeardChain& /*chain*/) {}
  /// Something is wrong with a port from now on, or no longer.
  virtual void report_trouble(std::uint8_t /*port*/, BusTrouble /*trouble*/, bool /*is_there*/) {}
  /// Something was wrong with an order that a port brought.
  virtual void report_order_trouble(std::uint8_t /*port*/, OrderTrouble /*trouble*/) {}
};

/// One way in and out of the vehicle computer. After construction nothing allocates and nothing waits.
/// A port of another kind (a serial line, a shared memory): connect_your_autopilot.md says how.
class Port {
 public:
  Port(std::uint8_t index, host::Roles roles) : roles_(roles) { report_.port = index; }
  virtual ~Port() = default;
  Port(const Port&) = delete;
  Port& operator=(const Port&) = delete;

  /// Gives `sink` all that has arrived, in order of arrival, at most so much that a flood cannot hold the loop.
  virtual void collect(Clock& clock, InputSink& sink) = 0;
  /// Sends what its roles ask for.
  /// @return set-points put on the bus
  virtual std::uint64_t publish(Time now, const runtime::Outputs& outputs) = 0;
  /// Sends a detection if its roles ask for that.
  virtual void publish_detection(const messages::SoundDetection& /*detection*/) {}
  /// How fast the vehicle moves through the water, once a turn, before its publish(): a hydrophone may then hear nothing but the vehicle.
  /// Always finite: where the last fix does not say, it is the speed of the last set-point, and zero before there was one. A vehicle does
  /// about what it is told; were the speed that nobody knows too fast, a vehicle without a log would never hear, and if it were never too
  /// fast, it would take its own noise for the sea's.
  virtual void note_speed(MetersPerSecond /*speed*/) {}
  /// Readable when collect() has something to read; -1 while the link is down.
  [[nodiscard]] virtual int file_descriptor() const = 0;
  /// Blocks of sound that it has listened to so far, and whose SNR, if they gave any, collect() has or can give.
  [[nodiscard]] virtual std::uint64_t blocks_heard() const { return 0; }
  /// Called about once a second of the host's time: opens again what is down.
  virtual void tend() {}
  /// Called at least ten times a second of the host's time, between turns, too: does what a bus wants of everybody on it.
  virtual void serve() {}
  /// Called before the first turn until it says that the port could send. What arrives meanwhile is no input.
  [[nodiscard]] virtual bool settle() { return true; }
  /// Counts what it received, lost and could not send so far.
  [[nodiscard]] virtual messages::PortReport report() const { return report_; }

  /// Its name and where it listens, for a person: "vehicle, LCM udpm://... on lo, eth0".
  [[nodiscard]] virtual std::string description() const = 0;
  /// The same in words that stay true while links come and go: "vehicle, LCM udpm://...".
  [[nodiscard]] virtual std::string label() const { return description(); }
  /// Bytes of its queues and buffers, if it has any, for the bill of the vehicle's memory.
  [[nodiscard]] virtual std::size_t memory() const { return 0; }
  /// What else a person should know at the end: what was lost where, and what to do about it; empty when there is nothing.
  [[nodiscard]] virtual std::string remark() const { return {}; }
  /// What somebody else sent into a simulation, and what became of it; empty when nobody did. A quiet program says it, too.
  [[nodiscard]] virtual std::string strangers() const { return {}; }

  [[nodiscard]] std::uint8_t index() const { return report_.port; }
  [[nodiscard]] bool has(host::Role role) const { return roles_.has(role); }

 protected:
  /// Says of an order, whose dates are still the sender's, what its mark is worth, and tells a person of one that is worth nothing.
  void judge_mark(const std::optional<host::CommandProof>& proof, messages::OperatorCommand& command, InputSink& sink) const {
    command.is_verified = command.has_old_mark = false;  // whatever its sender says
    if (!proof) return;
    proof->judge(command);
    if (command.is_verified || command.order == messages::Order::kAbort) return;
    sink.report_order_trouble(index(), command.has_old_mark ? OrderTrouble::kOldMark : OrderTrouble::kNoMark);
  }

  messages::PortReport report_;

 private:
  host::Roles roles_;
};

}  // namespace earshot::board
