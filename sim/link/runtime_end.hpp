#pragma once

#include <chrono>
#include <cstdint>
#include <memory>

#include "sim/link/mailbox.hpp"
#include "sim/link/messages.hpp"

namespace earshot::link {

/// The runtime's end of the link: receives ticks, sends answers. The thread that uses it never enters DDS: ticks come from Cyclone's
/// receive thread and answers leave through a thread of this end, both by mailbox.
class RuntimeEnd {
 public:
  /// Throws LinkError.
  explicit RuntimeEnd(std::uint32_t domain);
  /// Sends the last answer before it goes.
  ~RuntimeEnd();

  /// kLost when the simulator has left or has not been heard of for kLeaseSeconds.
  [[nodiscard]] Delivery receive(Tick& tick, std::chrono::milliseconds timeout);
  void send(const Answer& answer);

 private:
  struct Entities;
  std::unique_ptr<Entities> entities_;
};

}  // namespace earshot::link
