#pragma once

#include <cstddef>
#include <cstdint>

#include "firmware/boards/linux/clock/clock.hpp"
#include "firmware/boards/linux/port/further_duties.hpp"
#include "firmware/boards/linux/port/input_sink.hpp"
#include "firmware/boards/linux/port/port_words.hpp"
#include "firmware/core/time.hpp"
#include "firmware/host/mission/port_settings.hpp"
#include "firmware/messages/port_report.hpp"
#include "firmware/runtime/runtime.hpp"

namespace earshot::board {

/// One way in and out of the vehicle computer: owns its link, and the counts of what passed over it. After construction nothing allocates
/// and nothing waits, but for words(). A port of another kind (a serial line, a shared memory): connect_your_autopilot.md says how.
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
  /// Readable when collect() has something to read; -1 while the link is down.
  [[nodiscard]] virtual int file_descriptor() const = 0;
  /// Called about once a second of the host's time: opens again what is down.
  virtual void tend() {}
  /// Counts what it received, lost and could not send so far.
  [[nodiscard]] virtual messages::PortReport report() const { return report_; }
  /// Bytes of its queues and buffers, if it has any, for the bill of the vehicle's memory.
  [[nodiscard]] virtual std::size_t memory() const { return 0; }
  /// Before the first turn and after the last.
  [[nodiscard]] virtual PortWords words() const = 0;
  /// Asked for once. They live as long as the port.
  [[nodiscard]] virtual FurtherDuties further_duties() { return {}; }

  [[nodiscard]] std::uint8_t index() const { return report_.port; }
  [[nodiscard]] bool has(host::Role role) const { return roles_.has(role); }

 protected:
  messages::PortReport report_;

 private:
  host::Roles roles_;
};

}  // namespace earshot::board
