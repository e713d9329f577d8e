#pragma once

#include <poll.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "firmware/config/capacities.hpp"
#include "firmware/core/time.hpp"
#include "firmware/host/transport/timespec.hpp"
#include "firmware/runtime/runtime.hpp"

namespace earshot::board {

/// Mission time and when a turn of the loop is due: the host's clocks at sea (host_mission_clock.hpp), a simulator in lock-step
/// (sim/link/lock_step_clock.hpp). The loop is the same.
class Clock {
 public:
  enum class Wake : std::uint8_t {
    kNothing,  ///< look whether to stop; what the ports bring is not due yet, because the clock cannot date it
    kPorts,    ///< a port may have brought something, or it is time to look whether to stop
    kTurn,     ///< a turn is due once the ports have been read
    kAgain,    ///< who drives the clock asks again for what the last turn said (go_on_after())
    kLost,     ///< who drives the clock is gone, or what it announced does not arrive
  };

  Clock() = default;
  virtual ~Clock() = default;
  Clock(const Clock&) = delete;
  Clock& operator=(const Clock&) = delete;

  /// Whether whoever drives the clock is there by now.
  [[nodiscard]] virtual bool has_come(std::chrono::milliseconds /*most*/) { return true; }
  /// What was lost when wait() said kLost, for a person: "the simulator".
  [[nodiscard]] virtual std::string lost() const { return {}; }
  /// What else a person should know at the end; empty when there is nothing.
  [[nodiscard]] virtual std::string remark() const { return {}; }

  /// The time on the mission clock, which never goes back.
  [[nodiscard]] virtual Time now() = 0;
  /// Converts a date that a sender gave by its own wall clock to the mission clock.
  [[nodiscard]] virtual Time mission_time_of(Time utc) = 0;
  /// The other way: the wall clock's date of a moment of the mission, which is what a bus is told. A simulator's clock is the wall's to
  /// all.
  [[nodiscard]] virtual Time utc_of(Time mission_time) { return mission_time; }
  /// Converts the end of something heard, as the hydrophone's blocks are dated, to the mission clock. It lies before what is newest: the
  /// detector's filters take their time.
  [[nodiscard]] virtual Time time_heard(Time utc) { return mission_time_of(utc); }
  /// Whether what was heard may be taken at this moment, or must wait for the turn.
  [[nodiscard]] virtual bool takes_sound_now() const { return true; }
  /// Converts the arrival of something that bears no date to the mission clock. @param utc  when the kernel received it
  [[nodiscard]] virtual Time arrival_of(Time utc) = 0;

  /// Before the first wait(), of a mission that goes on: its journal ends there, which is past.
  virtual void be_at_least(Time /*mission_time*/) {}
  /// Before the first wait(): the mission goes on from its journal, and this is the health of its last turn.
  virtual void go_on_after(const messages::Health& /*last*/) {}

  /// What the loop waits for.
  struct Awaited {
    std::span<const pollfd> ports;       ///< readable when a port has something to read
    Time next_turn;                      ///< when a turn is due by the mission's period
    std::uint64_t navigation_taken = 0;  ///< fixes that the ports have brought so far
    std::uint64_t blocks_heard = 0;      ///< blocks of sound whose SNR, if they gave any, can be collected
  };
  /// Waits no longer than a tenth of a second of the host's time, so that a loop stops soon after it is told to.
  [[nodiscard]] virtual Wake wait(const Awaited& awaited) = 0;

  /// A turn has been made and its set-points are on their way. False: nobody waits for another.
  /// @param setpoints_sent  messages put on the buses so far
  [[nodiscard]] virtual bool answered(const runtime::Outputs& outputs, std::uint64_t setpoints_sent) = 0;
};

/// Until one of the ports is readable, but no longer than `most`.
inline void wait_for_ports(std::span<const pollfd> ports, Duration most) {
  std::array<pollfd, config::kMaxPorts> readable{};
  const std::size_t count = std::min(ports.size(), readable.size());
  std::copy_n(ports.begin(), count, readable.begin());
  const timespec timeout = host::timespec_of(most);
  (void)ppoll(readable.data(), count, &timeout, nullptr);
}

}  // namespace earshot::board
