#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "firmware/host/file/file_descriptor.hpp"
#include "firmware/messages/health.hpp"

namespace earshot::board {

/// What a service manager has put into the environment of a program that it started.
struct ServiceEnvironment {
  std::string socket;                                   ///< NOTIFY_SOCKET; empty: nobody wants to know
  std::optional<std::chrono::microseconds> watchdog{};  ///< WATCHDOG_USEC, where WATCHDOG_PID is this process or says nothing

  [[nodiscard]] static ServiceEnvironment of_this_process();
};

/// Tells systemd, or whoever speaks its protocol, how the mission goes: READY=1 after the first turn, STATUS= in words with every new
/// state and step, WATCHDOG=1 at most four times in the time that the watchdog allows, and STOPPING=1. One datagram each; nothing waits or
/// allocates after construction, and a manager who does not read is told nothing.
///
/// The watchdog is fed by the heartbeat alone: by a turn that the runtime has counted after its safety filter. A thread that lives while
/// the runtime is hung feeds nothing. But for a runtime that has found its own memory damaged, which counts no turn any more: it brings the
/// vehicle up, and a new process could do no better.
/// Source: sd_notify(3).   Oracle: ServiceManager.* in tests/firmware/boards/linux/service
class ServiceManager {
 public:
  using SteadyClock = std::chrono::steady_clock;

  explicit ServiceManager(const ServiceEnvironment& environment);

  /// Why the manager cannot be told anything; empty: it can, or there is none.
  [[nodiscard]] const std::string& complaint() const { return complaint_; }

  /// After each turn. @param now  on this host's clock
  void note_turn(const messages::Health& health, SteadyClock::time_point now = SteadyClock::now());
  /// The program was told to stop.
  void note_stop();
  /// The start takes longer than the manager waits by itself. @param more  from now
  void ask_for(std::chrono::seconds more);

 private:
  void notify(std::string_view message) const;
  void notify_state(const messages::Health& health) const;

  host::FileDescriptor socket_;
  std::string complaint_;
  std::optional<std::chrono::microseconds> between_meals_;  ///< of the watchdog
  std::optional<SteadyClock::time_point> fed_;
  bool is_ready_ = false;
  bool is_stopping_ = false;
  std::uint64_t turn_ = 0;  ///< of the last heartbeat
  std::optional<messages::MissionState> state_;
  std::uint32_t steps_taken_ = 0;
};

}  // namespace earshot::board
