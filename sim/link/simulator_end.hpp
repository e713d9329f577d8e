#pragma once

#include <chrono>
#include <cstdint>
#include <memory>

#include "sim/link/mailbox.hpp"
#include "sim/link/messages.hpp"

namespace earshot::link {

/// The simulator's end of the link: sends ticks and ground truth, receives answers. One thread uses it.
class SimulatorEnd {
 public:
  /// Throws LinkError.
  explicit SimulatorEnd(std::uint32_t domain);
  ~SimulatorEnd();

  /// True as soon as a runtime listens in this domain.
  [[nodiscard]] bool wait_for_runtime(std::chrono::milliseconds timeout);
  /// Throws LinkError.
  void send(const Tick& tick);
  /// kLost when the runtime has left or has not been heard of for kLeaseSeconds.
  [[nodiscard]] Delivery receive(Answer& answer, std::chrono::milliseconds timeout);
  void observe(const GroundTruth& truth);

 private:
  struct Entities;
  std::unique_ptr<Entities> entities_;
};

}  // namespace earshot::link
