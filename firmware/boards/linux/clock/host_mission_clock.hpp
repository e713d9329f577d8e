#pragma once

#include <optional>

#include "firmware/boards/linux/clock/clock.hpp"
#include "firmware/boards/linux/clock/host_clock.hpp"
#include "firmware/core/time.hpp"

namespace earshot::board {

/// Mission time at sea: UTC as it is when this is made, and after that it only runs on, whatever becomes of the wall clock. A date by the
/// wall clock is moved by its age: when the wall clock is set, its senders' dates and its own reading move together.
class HostMissionClock final : public Clock {
 public:
  /// @param host   must outlive it
  /// @param speed  mission seconds per second of the host, > 0: a rehearsal may run faster or slower
  /// @param since  UTC from which `speed` counts, now or earlier: the mission clocks of two processes, made one after the other, are then
  /// one;
  ///               nothing: from now on
  explicit HostMissionClock(const HostClock& host, double speed = 1.0, std::optional<Time> since = std::nullopt);

  /// Of a mission that goes on: begins at this mission time, whatever the wall clock says.
  void go_on_at(Time mission_time) { began_ = mission_time, began_on_host_ = host_.monotonic(); }
  /// Likewise, by what it was so long ago on the host.
  void go_on_since(Time mission_time, Duration passed_on_host);

  void be_at_least(Time mission_time) override;
  [[nodiscard]] Time now() override;
  [[nodiscard]] Time mission_time_of(Time utc) override;
  [[nodiscard]] Time utc_of(Time mission_time) override;
  [[nodiscard]] Time arrival_of(Time utc) override { return mission_time_of(utc); }
  [[nodiscard]] Wake wait(const Awaited& awaited) override;
  /// After DONE or ABORT the autopilot is told to come up until somebody stops the program.
  [[nodiscard]] bool answered(const runtime::Outputs& /*outputs*/, std::uint64_t /*setpoints_sent*/) override { return true; }

 private:
  struct Moment {
    Time utc;
    Duration monotonic;
  };
  [[nodiscard]] static Moment moment_of(const HostClock& host);
  /// A reading of both that is not too old.
  [[nodiscard]] const Moment& moment();
  [[nodiscard]] Time mission_time_at(const Moment& moment) const;

  const HostClock& host_;
  double speed_;
  Time began_;
  Duration began_on_host_;
  Moment moment_;  ///< the newest reading of both
};

}  // namespace earshot::board
