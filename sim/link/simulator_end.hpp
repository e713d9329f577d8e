#pragma once

#include <chrono>
#include <cstdint>
#include <memory>

#include "sim/link/mailbox.hpp"
#include "sim/link/messages.hpp"
#include "sim/link/session.hpp"

namespace earshot::link {

/// The simulator's end of the link: sends ticks and ground truth, receives answers. One thread uses it.
class SimulatorEnd {
 public:
  /// @param run  that a runtime may have been told to wait for; not 0. Throws LinkError.
  explicit SimulatorEnd(std::uint32_t domain, RunId run = new_run());
  ~SimulatorEnd();

  /// Knocks until a runtime answers that it is ready for the first tick. From then on only that one is heard. Throws LinkError.
  [[nodiscard]] bool wait_for_runtime(std::chrono::milliseconds timeout);
  /// Turns that the runtime that answered had behind it already: it goes on from its journal.
  [[nodiscard]] std::uint64_t turns_made() const { return turns_made_; }
  /// The runtime is lost: the next wait_for_runtime() waits for another of the same run. Throws LinkError.
  void give_up_runtime();
  /// Throws LinkError.
  void send(const Tick& tick);
  /// kLost when the runtime has left or has not been heard of for kLeaseSeconds.
  [[nodiscard]] Delivery receive(Answer& answer, std::chrono::milliseconds timeout);
  /// Answers of other runtimes in the domain, or to other simulators, that were ignored.
  [[nodiscard]] std::uint64_t strangers() const;
  void observe(const GroundTruth& truth);

 private:
  struct Entities;
  std::uint32_t domain_;
  RunId run_;
  std::uint64_t turns_made_ = 0;
  std::uint64_t strangers_before_ = 0;  ///< of the runtimes before this one
  std::unique_ptr<Entities> entities_;
};

}  // namespace earshot::link
