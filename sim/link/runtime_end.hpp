#pragma once

#include <chrono>
#include <cstdint>
#include <memory>

#include "sim/link/mailbox.hpp"
#include "sim/link/messages.hpp"
#include "sim/link/session.hpp"

namespace earshot::link {

/// The runtime's end of the link: receives ticks, sends answers. The thread that uses it never enters DDS: ticks come from Cyclone's
/// receive thread and answers leave through a thread of this end, both by mailbox.
class RuntimeEnd {
 public:
  /// @param run  that it belongs to; 0: that of the first simulator that knocks. Throws LinkError.
  explicit RuntimeEnd(std::uint32_t domain, RunId run = 0);
  /// Sends the last answer before it goes.
  ~RuntimeEnd();

  /// True as soon as a simulator has knocked. From then on only that one is heard; it waits until receive() is called.
  [[nodiscard]] bool wait_for_simulator(std::chrono::milliseconds timeout);
  /// kLost when the simulator has left or has not been heard of for kLeaseSeconds.
  [[nodiscard]] Delivery receive(Tick& tick, std::chrono::milliseconds timeout);
  void send(const Answer& answer);
  /// What a knock is answered with: turns that another process made before this one.
  void go_on_after(std::uint64_t turns_made) { turns_made_ = turns_made; }
  /// Ticks of other simulators in the domain that were ignored.
  [[nodiscard]] std::uint64_t strangers() const;

 private:
  struct Entities;
  std::unique_ptr<Entities> entities_;
  std::uint64_t turns_made_ = 0;
};

}  // namespace earshot::link
