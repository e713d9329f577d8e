#pragma once

#include <optional>

#include "firmware/core/time.hpp"

namespace earshot::board {

/// Turns the dates of one kind of message into mission time, though the sender's wall clock is wrong, or is set while it sends.
///
/// A date within half the kind's timeout of now is believed, and moved by what the sender's clock is known to be off (nothing, at first).
/// Another is refused, unless such dates have run on like the mission's clock for a quarter of the timeout: then the sender's clock was
/// set, and is known to be off by that much from now on. A message repeated for ever does not run on; one bad sender beside a good one is
/// not believed.
class SenderClock {
 public:
  /// @param timeout  after which this kind of message is stale
  explicit SenderClock(Duration timeout) : believed_{timeout.us / 2}, run_length_{timeout.us / 4}, run_slack_{timeout.us / 8} {}

  /// @param now  when the message arrived, mission time
  /// @return nothing: refused
  [[nodiscard]] std::optional<Time> to_mission_time(Time date, Time now);

 private:
  struct Arrival {
    Time date;
    Time now;
  };

  Duration believed_;
  Duration run_length_;
  Duration run_slack_;
  Duration off_;                    ///< mission time less the sender's
  std::optional<Arrival> strange_;  ///< the first of a run of dates that are not believed
};

}  // namespace earshot::board
